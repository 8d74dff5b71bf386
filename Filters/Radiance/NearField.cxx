#include "NearField.h"

#include "PolygonLight.h"
#include "Scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

namespace smokevis
{

namespace
{

/// Steps of a level's lattice from the plate to the level's end, and as long ones along it: of the
/// innermost of a pattern, which is interpolated linearly, and of others.
constexpr int InnermostSteps = 6;
constexpr int Steps = 5;
constexpr int CoarseSteps = 3;
/// Steps of the innermost from the plate to its end, each longer than the one before: in smoke,
/// light falls off most steeply right at the plate.
constexpr int GradedSteps = 10;
constexpr int CoarseGradedSteps = 8;
/// The innermost level of a single leaf reaches so far, in shares of its shortest edge, with steps
/// along it as if it reached one such edge: there is no pattern.
constexpr double SingleLeafShare = 0.125;
/// How many times as many steps a light takes that is not Lambertian: what is left of it over that
/// of an even plate falls off with the angle.
constexpr int LawSteps = 2;
/// The innermost level has no more steps than this along one side of the plate, unless light is
/// asked for no farther than that.
constexpr double MostStepsAcross = 96.0;
/// Nodes in the plane of the plate are taken this share of the step in front of it.
constexpr double Lift = 1e-4;

/// Optical depth of a step, in smoke as thick as at the plate, above which the logarithm of the
/// fluence is interpolated, and above which nodes tell nothing of places between them: where that
/// smoke ends, what even smoke would dim is many times off.
constexpr double ThinStep = 0.5;
constexpr double ThickStep = 2.0;

/// Optical depth of even smoke up to which the light that is left without it, many times that with
/// it, does not overflow single precision.
constexpr double LargestPlainDepth = 50.0;

/// Places on the border of two boxes belong to the inner one, and those halfway between two nodes
/// to the upper one: cells often lie so that rounding would decide.
constexpr double Hair = 1e-6;
constexpr double Inwards = 1.0 - Hair;

/// Counts that come out whole but for rounding are whole.
constexpr double Rounding = 1e-4;

/// Shortest edge of a group's leaves [m].
double FinestEdge(const EmitterSet& lights, const LightGroup& group)
{
  if (group.FirstChild >= 0)
  {
    return std::min(FinestEdge(lights, lights.Groups()[group.FirstChild]),
      FinestEdge(lights, lights.Groups()[group.FirstChild + 1]));
  }
  double finest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i)
  {
    const double edge = glm::length(group.Corners[(i + 1) % 4] - group.Corners[i]);
    finest = edge > 0.0 ? std::min(finest, edge) : finest;
  }
  return finest;
}

} // namespace

struct NearField::Level
{
  /// Distance from the plate that it reaches [m].
  double Reach = 0.0;
  std::array<double, 3> First{}, Step{};
  std::array<int, 3> Count{};
  /// Whether distances from the plate go with the square of their number.
  bool Graded = false;
  /// Whether values are logarithms.
  bool Logarithms = true;
  /// NaN: not computed yet. Band after band, first axis fastest.
  mutable std::vector<std::atomic<float>> Values;

  double Place(int axis, int node) const
  {
    const double even = this->First[axis] + node * this->Step[axis];
    return axis == 2 && this->Graded ? even * even / this->Reach : even;
  }
  /// Number of a place along an axis, whole at nodes.
  double Number(int axis, double place) const
  {
    const double even = axis == 2 && this->Graded ? std::sqrt(place * this->Reach) : place;
    return (even - this->First[axis]) / this->Step[axis];
  }

  std::size_t Index(const std::array<int, 3>& node, int band) const
  {
    return ((static_cast<std::size_t>(band) * this->Count[2] + node[2]) * this->Count[1] +
             node[1]) *
             this->Count[0] +
           node[0];
  }
};

NearField::NearField(const Scene& scene, const DirectLight& direct, std::size_t light, double reach,
  double longestStep, bool coarse)
    : Scene_(scene), Direct_(direct), Light_(light)
{
  const EmitterSet& lights = scene.Lights();
  const LightGroup& root = lights.Root(light);
  this->Axes_[2] = root.Normal;
  const Vec3 along = root.Corners[1] - root.Corners[0];
  this->Axes_[0] = glm::normalize(along - glm::dot(along, root.Normal) * root.Normal);
  this->Axes_[1] = glm::cross(root.Normal, this->Axes_[0]);
  std::array<double, 2> low = {1e300, 1e300};
  std::array<double, 2> high = {-1e300, -1e300};
  for (const Vec3& corner : root.Corners)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const double place = glm::dot(corner - root.Centre, this->Axes_[axis]);
      low[axis] = std::min(low[axis], place);
      high[axis] = std::max(high[axis], place);
    }
  }
  this->Centre_ = root.Centre;
  for (int axis = 0; axis < 2; ++axis)
  {
    this->Half_[axis] = 0.5 * (high[axis] - low[axis]);
    this->Centre_ += 0.5 * (low[axis] + high[axis]) * this->Axes_[axis];
  }
  const double longest = 2.0 * std::max(this->Half_[0], this->Half_[1]);
  const std::int64_t cell =
    scene.Smoke().Locate(this->Centre_ + 10.0 * scene.Shapes().Tolerance() * root.Normal);
  this->Extinction_ = cell < 0 ? 0.0 : scene.Smoke().Extinction(cell);

  const int finer = root.Law.Lambertian() ? 1 : LawSteps;
  const int outerSteps = finer * (coarse ? CoarseSteps : Steps);
  // The innermost level follows the plate's pattern.
  const double finest = FinestEdge(lights, root);
  if (root.FirstChild >= 0)
  {
    this->PatternLength_ = finest;
  }
  // In smoke that asks for short steps, more nodes would be filled than places are asked for.
  const bool single = root.FirstChild < 0 && std::min(reach, finest) <= outerSteps * longestStep;
  double first = std::max(
    single ? SingleLeafShare * finest : finest, finer * InnermostSteps * longest / MostStepsAcross);
  first = std::min(first, std::max(reach, 1e-9));
  for (double distance = first;; distance *= 2.0)
  {
    const double step = this->Levels_.empty()
                          ? std::max(first, std::min(finest, reach)) / (finer * InnermostSteps)
                          : std::min(longestStep, distance / outerSteps);
    if (this->Extinction_ * scene.LargestScale() * step > ThickStep)
    {
      break;
    }
    auto level = std::make_unique<Level>();
    level->Reach = distance;
    level->Graded = this->Levels_.empty();
    for (int axis = 0; axis < 3; ++axis)
    {
      const double half = axis < 2 ? this->Half_[axis] + distance : 0.5 * distance;
      int steps = axis == 2 && level->Graded
                    ? finer * (coarse ? CoarseGradedSteps : GradedSteps)
                    : static_cast<int>(std::ceil(2.0 * half / step - Rounding));
      // Through the plate's middle often go faces of cells, along which rounding would decide whose
      // smoke a way leads through: no nodes there.
      steps |= axis < 2 && !level->Graded ? 1 : 0;
      level->Count[axis] = steps + 1;
      level->Step[axis] = 2.0 * half / steps;
      level->First[axis] = axis < 2 ? -half : 0.0;
    }
    // Only a level that is interpolated linearly can do without them.
    const Vec3 corner = {this->Half_[0] + distance, this->Half_[1] + distance, distance};
    level->Logarithms = !level->Graded;
    for (int band = 0; band < scene.Bands(); ++band)
    {
      level->Logarithms = level->Logarithms || this->EvenDepth(corner, band) > LargestPlainDepth;
    }
    level->Values =
      std::vector<std::atomic<float>>(static_cast<std::size_t>(level->Count[0]) * level->Count[1] *
                                      level->Count[2] * scene.Bands());
    for (std::atomic<float>& value : level->Values)
    {
      value.store(std::numeric_limits<float>::quiet_NaN(), std::memory_order_relaxed);
    }
    this->Levels_.push_back(std::move(level));
    if (distance >= reach * (1.0 - Rounding))
    {
      break;
    }
  }
}

NearField::~NearField() = default;

Vec3 NearField::ToPlate(const Vec3& point) const
{
  const Vec3 from = point - this->Centre_;
  return {
    glm::dot(from, this->Axes_[0]), glm::dot(from, this->Axes_[1]), glm::dot(from, this->Axes_[2])};
}

Vec3 NearField::FromPlate(const Vec3& place) const
{
  return this->Centre_ + place.x * this->Axes_[0] + place.y * this->Axes_[1] +
         place.z * this->Axes_[2];
}

double NearField::PlateAngle(const Vec3& point) const
{
  return SolidAngle(point, this->Scene_.Lights().Root(this->Light_).Corners);
}

double NearField::EvenDepth(const Vec3& place, int band) const
{
  // The root of the mean square of the distances to all places of the plate.
  const double plate = (this->Half_[0] * this->Half_[0] + this->Half_[1] * this->Half_[1]) / 3.0;
  return this->Extinction_ * this->Scene_.ExtinctionScale(band) *
         std::sqrt(glm::dot(place, place) + plate);
}

float NearField::FillNode(const Level& level, const std::array<int, 3>& node, int band) const
{
  Vec3 place;
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = level.Place(axis, node[axis]);
  }
  place.z = std::max(place.z, Lift * level.Step[2]);
  const Vec3 point = this->FromPlate(place);
  const Spectrum fluence = this->Direct_.Fluence(this->Light_, point, true);
  const double angle = this->PlateAngle(point);
  float asked = 0.0F;
  for (int each = 0; each < this->Scene_.Bands(); ++each)
  {
    const double ratio = angle > 0.0 ? fluence[each] / angle : 0.0;
    const double depth = this->EvenDepth(place, each);
    const auto value =
      static_cast<float>(level.Logarithms ? std::log(ratio) + depth : ratio * std::exp(depth));
    level.Values[level.Index(node, each)].store(value, std::memory_order_relaxed);
    asked = each == band ? value : asked;
  }
  return asked;
}

double NearField::Away(const Vec3& place) const
{
  return Inwards * std::max({std::abs(place.x) - this->Half_[0], std::abs(place.y) - this->Half_[1],
                     place.z, 0.0});
}

bool NearField::Smooth(const Vec3& point) const
{
  return !this->Levels_.empty() && this->Away(this->ToPlate(point)) > this->Levels_.front()->Reach;
}

double NearField::Fluence(const Vec3& point, int band) const
{
  const Vec3 place = this->ToPlate(point);
  if (!(place.z > 0.0))
  {
    return 0.0;
  }
  const auto found = std::lower_bound(this->Levels_.begin(), this->Levels_.end(), this->Away(place),
    [](const std::unique_ptr<Level>& level, double value) { return level->Reach < value; });
  if (found == this->Levels_.end())
  {
    return this->Direct_.Fluence(this->Light_, point, true)[band];
  }
  const Level& level = **found;
  const double even = this->PlateAngle(point);
  if (found != this->Levels_.begin())
  {
    const double logarithm = this->Quadratic(level, place, band);
    if (std::isfinite(logarithm))
    {
      return even * std::exp(logarithm - this->EvenDepth(place, band));
    }
  }
  return even * this->Linear(level, place, band);
}

double NearField::Quadratic(const Level& level, const Vec3& place, int band) const
{
  // The polynomial of the second degree in all axes together through ten nodes, where that of the
  // second degree in each takes 27: the nearest node, its neighbours along the axes, and one beside
  // it in each plane, on the side where the place lies.
  std::array<int, 3> nearest, side;
  Vec3 off;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = (place[axis] - level.First[axis]) / level.Step[axis];
    nearest[axis] =
      std::clamp(static_cast<int>(std::floor(at + 0.5 + Hair)), 1, level.Count[axis] - 2);
    side[axis] = at < nearest[axis] ? -1 : 1;
    off[axis] = side[axis] * (at - nearest[axis]);
  }
  const std::atomic<float>* const values = level.Values.data() + level.Index(nearest, band);
  const std::ptrdiff_t row = level.Count[0];
  const std::ptrdiff_t layer = row * level.Count[1];
  // So many nodes from the nearest, towards the place.
  const auto value = [&](int x, int y, int z) -> double
  {
    x *= side[0];
    y *= side[1];
    z *= side[2];
    const float known = values[x + y * row + z * layer].load(std::memory_order_relaxed);
    return std::isnan(known)
             ? this->FillNode(level, {nearest[0] + x, nearest[1] + y, nearest[2] + z}, band)
             : known;
  };
  const double middle = value(0, 0, 0);
  const std::array<double, 3> ahead = {value(1, 0, 0), value(0, 1, 0), value(0, 0, 1)};
  const std::array<double, 3> behind = {value(-1, 0, 0), value(0, -1, 0), value(0, 0, -1)};
  const std::array<double, 3> beside = {value(1, 1, 0), value(0, 1, 1), value(1, 0, 1)};
  double sum = middle;
  double least = middle;
  double most = middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int next = (axis + 1) % 3;
    const double t = off[axis];
    sum += 0.5 * t *
           ((ahead[axis] - behind[axis]) + t * ((ahead[axis] - middle) + (behind[axis] - middle)));
    sum += t * off[next] * ((beside[axis] - ahead[axis]) - (ahead[next] - middle));
    least = std::min(least, std::min(std::min(ahead[axis], behind[axis]), beside[axis]));
    most = std::max(most, std::max(std::max(ahead[axis], behind[axis]), beside[axis]));
  }
  // Where smoke changes from cell to cell by much, a quadratic would overshoot.
  return std::isfinite(least) ? std::clamp(sum, least, most) : least;
}

double NearField::Linear(const Level& level, const Vec3& place, int band) const
{
  std::array<int, 3> node;
  std::array<double, 3> share;
  for (int axis = 0; axis < 3; ++axis)
  {
    node[axis] =
      std::clamp(static_cast<int>(level.Number(axis, place[axis])), 0, level.Count[axis] - 2);
    const double begin = level.Place(axis, node[axis]);
    const double end = level.Place(axis, node[axis] + 1);
    share[axis] = std::clamp((place[axis] - begin) / (end - begin), 0.0, 1.0);
  }
  const double depth = this->EvenDepth(place, band);
  // Before a dark part of a pattern the fluence goes to 0 in proportion to the distance, in thick
  // smoke exponentially.
  const double stepDepth = this->Extinction_ * this->Scene_.ExtinctionScale(band) *
                           (level.Place(2, node[2] + 1) - level.Place(2, node[2]));
  const std::atomic<float>* const values = level.Values.data() + level.Index(node, band);
  const std::ptrdiff_t row = level.Count[0];
  const std::ptrdiff_t layer = row * level.Count[1];
  std::array<double, 8> corners, weights;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int x = corner & 1;
    const int y = corner >> 1 & 1;
    const int z = corner >> 2;
    const float known = values[x + y * row + z * layer].load(std::memory_order_relaxed);
    corners[corner] = std::isnan(known)
                        ? this->FillNode(level, {node[0] + x, node[1] + y, node[2] + z}, band)
                        : known;
    weights[corner] = (x == 1 ? share[0] : 1.0 - share[0]) * (y == 1 ? share[1] : 1.0 - share[1]) *
                      (z == 1 ? share[2] : 1.0 - share[2]);
  }
  const auto mean = [&](const auto& of)
  {
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      sum += weights[corner] * of(corners[corner]);
    }
    return sum;
  };
  if (stepDepth > ThinStep)
  {
    const double logarithm =
      mean([&level](double value) { return level.Logarithms ? value : std::log(value); });
    if (std::isfinite(logarithm))
    {
      return std::exp(logarithm - depth);
    }
  }
  return level.Logarithms ? mean([depth](double value) { return std::exp(value - depth); })
                          : std::exp(-depth) * mean([](double value) { return value; });
}

} // namespace smokevis
