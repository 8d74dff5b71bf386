#include "DirectField.h"

#include "GaussNodes.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// A light counts as near to a cell within so many cell edges of the cell. Not a whole number, so
/// that no distance of a regular scene is at the limit, where rounding would decide.
constexpr double NearEdges = 4.01;
/// Closer than this, a cell's mean is not found from a few points.
constexpr double CloseEdges = 2.01;
/// Optical depth across a cell below which its light is flat enough, that of the pieces that
/// thicker ones are cut into, and most pieces of one.
constexpr double FlatDepth = 0.41;
constexpr double PieceDepth = 0.5;
constexpr int MostPieces = 8;
/// Sharpest law of emission of lights whose fluence is kept on lattices.
constexpr double SmoothestLaw = 2.0;
/// Parts of a piece of a ray near a light: most, where the smoke is thick; and, where the ray runs
/// into the plate, how many and how much closer to the plate each ends.
constexpr int MostParts = 16;
constexpr int GradedParts = 2;
constexpr double Grading = 0.25;
/// A part that spans less than this angle at the light and less than this optical depth needs two
/// Gauss points, or one: the errors of the rules are angle^4 / 4320 and angle^2 / 24.
constexpr double TwoPointAngle = 0.8;
constexpr double OnePointAngle = 0.15;

struct GaussRule
{
  int Count;
  std::array<double, 4> Nodes, Weights;
};
constexpr GaussRule OnePoint = {1, {0.5}, {1.0}};
constexpr GaussRule TwoPoints = {2, {Nodes2[0], Nodes2[1]}, {0.5, 0.5}};
constexpr GaussRule FourPoints = {4, Nodes4, Weights4};

const GaussRule& RuleFor(double angle, double depth)
{
  return angle < OnePointAngle && depth < OnePointAngle   ? OnePoint
         : angle < TwoPointAngle && depth < TwoPointAngle ? TwoPoints
                                                          : FourPoints;
}

/// Equiangular places about a light follow 1/d^2 along a ray (Kulla and Fajardo 2012); a light of
/// some size is no steeper than its radius.
struct Equiangular
{
  double Middle;
  double Width;

  Equiangular(const LightGroup& light, const Vec3& origin, const Vec3& direction)
      : Middle(glm::dot(light.Centre - origin, direction))
  {
    const double aside = glm::length(origin + this->Middle * direction - light.Centre);
    this->Width = std::max({aside, 0.5 * light.Radius, 1e-9});
  }

  /// Calls visit(distance along the ray, step) for the places of a rule between two distances.
  template <class Visit>
  void ForEach(double from, double to, double extinction, Visit&& visit) const
  {
    const double low = std::atan((from - this->Middle) / this->Width);
    const double high = std::atan((to - this->Middle) / this->Width);
    const GaussRule& rule = RuleFor(high - low, extinction * (to - from));
    for (int i = 0; i < rule.Count; ++i)
    {
      const double tangent = std::tan(low + (high - low) * rule.Nodes[i]);
      const double distance = std::clamp(this->Middle + this->Width * tangent, from, to);
      visit(distance, rule.Weights[i] * (high - low) * this->Width * (1.0 + tangent * tangent));
    }
  }
};

/// Ends of the parts that a piece of a ray near a light is cut into; returns their number.
int PartEnds(const LightGroup& light, const Vec3& origin, const Vec3& direction, double begin,
  double end, double extinction, std::array<double, MostParts + 1>& ends)
{
  ends[0] = begin;
  const double first = glm::dot(origin + begin * direction - light.Centre, light.Normal);
  double last = glm::dot(origin + end * direction - light.Centre, light.Normal);
  // A ray that ends on the plate may seem to end behind it.
  last = std::abs(last) < 1e-6 * first ? 0.0 : last;
  const double close = glm::length(origin + end * direction - light.Centre);
  if (last >= 0.0 && last < 0.3 * first && close < 1.5 * light.Radius)
  {
    // The ray ends close to the plate, where the light follows the pattern: parts shrink towards
    // it.
    int parts = 0;
    for (double height = first; parts + 1 < GradedParts && height * Grading > last;)
    {
      height *= Grading;
      ends[++parts] = begin + (end - begin) * (first - height) / (first - last);
    }
    ends[++parts] = end;
    return parts;
  }
  // The parts are shorter where the smoke is thick.
  const int parts =
    std::clamp(static_cast<int>(std::ceil(extinction * (end - begin))), 1, MostParts);
  for (int part = 1; part <= parts; ++part)
  {
    ends[part] = part == parts ? end : begin + (end - begin) * part / parts;
  }
  return parts;
}

} // namespace

DirectField::DirectField(const Scene& scene, const LightField& field)
    : Scene_(scene), Field_(field), Direct_(scene), Open_(scene), Cells_(field.Cells),
      Means_(field.DirectFluence), Shapes_(field.Bands)
{
  if (scene.Smoke().Empty() || scene.Albedo() == 0.0)
  {
    return;
  }
  this->FindNearCells();
  const auto alike = [this](std::int64_t cell, std::int64_t other)
  {
    const std::int32_t index = this->NearIndex_[other];
    if (index < 0)
    {
      return false;
    }
    const std::vector<NearLight>& first = this->NearCells_[this->NearIndex_[cell]].Lights;
    const std::vector<NearLight>& second = this->NearCells_[index].Lights;
    return std::equal(first.begin(), first.end(), second.begin(), second.end(),
      [](const NearLight& one, const NearLight& two) { return one.Light == two.Light; });
  };
  this->FindVarying();
  for (int band = 0; band < field.Bands; ++band)
  {
    const float* all = field.DirectFluence.data() + field.CellIndex(band, 0);
    const float* others = this->Means_.data() + field.CellIndex(band, 0);
    this->Shapes_[band] = CellShape(scene, this->Open_,
      [&](std::int64_t cell, std::int64_t other)
      {
        // Without its near lights, a cell is like those that lack the same.
        return !this->Near(cell) ? all[other] : alike(cell, other) ? others[other] : 0.0F;
      });
  }
}

void DirectField::FindNearCells()
{
  const Medium& smoke = this->Scene_.Smoke();
  const EmitterSet& lights = this->Scene_.Lights();
  std::vector<double> reach(lights.Lights().size(), 0.0);
  this->NearIndex_.assign(this->Cells_, -1);
  std::vector<std::int64_t> cells;
  for (std::size_t light = 0; light < lights.Lights().size(); ++light)
  {
    const LightGroup& root = lights.Groups()[lights.Lights()[light]];
    const double largest = NearEdges * smoke.LargestEdge();
    const Vec3 low = glm::min(glm::min(root.Corners[0], root.Corners[1]),
                       glm::min(root.Corners[2], root.Corners[3])) -
                     largest;
    const Vec3 high = glm::max(glm::max(root.Corners[0], root.Corners[1]),
                        glm::max(root.Corners[2], root.Corners[3])) +
                      largest;
    smoke.ForCellsIn(low, high,
      [&](std::int64_t cell)
      {
        if (smoke.Extinction(cell) == 0.0F)
        {
          return;
        }
        const Vec3 centre = smoke.CellCentre(cell);
        const Vec3 size = smoke.CellSize(cell);
        const double distance = root.Distance(centre);
        // Behind a plate there is none of its light.
        if (distance >= NearEdges * std::max({size.x, size.y, size.z}) ||
            glm::dot(centre - root.Centre, root.Normal) <= -root.Radius - glm::length(size))
        {
          return;
        }
        if (this->NearIndex_[cell] < 0)
        {
          this->NearIndex_[cell] = static_cast<std::int32_t>(this->NearCells_.size());
          this->NearCells_.emplace_back();
          cells.push_back(cell);
        }
        this->NearCells_[this->NearIndex_[cell]].Lights.push_back(
          {static_cast<std::uint32_t>(light), false, {}});
        reach[light] = std::max(reach[light], distance + 0.5 * glm::length(size));
      });
  }
  this->NearFields_.resize(reach.size());
  for (std::size_t light = 0; light < reach.size(); ++light)
  {
    // Light that changes quickly with the angle, as measured light may near the plate's plane,
    // would need finer lattices.
    const LightGroup& root = lights.Groups()[lights.Lights()[light]];
    if (reach[light] > 0.0 && !root.Law.Measured() && root.Law.Sharpness() <= SmoothestLaw)
    {
      this->NearFields_[light] =
        std::make_unique<NearField>(this->Scene_, this->Direct_, light, reach[light]);
    }
  }
  tbb::parallel_for(std::size_t{0}, cells.size(),
    [&](std::size_t i)
    {
      const Spectrum others = this->MeasureNearCell(cells[i], this->NearCells_[i]);
      for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
      {
        this->Means_[band * this->Cells_ + cells[i]] = static_cast<float>(others[band]);
      }
    });
}

Spectrum DirectField::MeasureNearCell(std::int64_t cell, NearCell& near) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  const Vec3 centre = this->Scene_.Smoke().CellCentre(cell);
  const Vec3 size = this->Scene_.Smoke().CellSize(cell);
  const bool part = this->Scene_.Smoke().Parts().Find(cell) != nullptr;
  double distance = 1e300;
  for (NearLight& light : near.Lights)
  {
    light.Clear = this->Direct_.Clear(light.Light, cell);
    if (!light.Clear || !this->NearFields_[light.Light] || part)
    {
      light.Mean = this->Direct_.CellFluence(light.Light, cell);
    }
    distance = std::min(distance, lights.Groups()[lights.Lights()[light.Light]].Distance(centre));
  }
  near.Close = distance < CloseEdges * std::max({size.x, size.y, size.z});
  if (near.Lights.size() == lights.Lights().size())
  {
    return {};
  }
  if (near.Close && !part)
  {
    return this->OthersFluence(cell, near);
  }
  // Eight Gauss points know the near lights' mean to a percent, and take it from that of all.
  Spectrum others{};
  for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
  {
    others[band] = this->Means_[band * this->Cells_ + cell];
  }
  for (const NearLight& light : near.Lights)
  {
    for (std::size_t band = 0; band < this->Shapes_.size() && part; ++band)
    {
      others[band] -= light.Mean[band];
    }
    for (int point = 0; point < 8 && !part; ++point)
    {
      const Vec3 share(Nodes2[point & 1], Nodes2[point >> 1 & 1], Nodes2[point >> 2 & 1]);
      const Spectrum value =
        this->Direct_.Fluence(light.Light, centre + (share - 0.5) * size, light.Clear);
      for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
      {
        others[band] -= 0.125 * value[band];
      }
    }
  }
  for (double& value : others)
  {
    value = std::max(0.0, value);
  }
  return others;
}

Spectrum DirectField::OthersFluence(std::int64_t cell, const NearCell& near) const
{
  Spectrum sum{};
  auto skip = near.Lights.begin();
  for (std::size_t light = 0; light < this->Scene_.Lights().Lights().size(); ++light)
  {
    if (skip != near.Lights.end() && skip->Light == light)
    {
      ++skip;
      continue;
    }
    const Spectrum value = this->Direct_.CellFluence(light, cell);
    for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
    {
      sum[band] += value[band];
    }
  }
  return sum;
}

void DirectField::FindVarying()
{
  const Medium& smoke = this->Scene_.Smoke();
  this->Varies_.resize(this->Shapes_.size() * this->Cells_);
  for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
  {
    for (std::size_t i = 0; i < this->Cells_; ++i)
    {
      const auto cell = static_cast<std::int64_t>(i);
      const Vec3 size = smoke.CellSize(cell);
      const double depth = smoke.Extinction(cell) * std::max({size.x, size.y, size.z}) *
                           this->Scene_.ExtinctionScale(static_cast<int>(band));
      const std::size_t index = band * this->Cells_ + i;
      // In the thickest cells pieces would not follow the light; means keep the balance of power.
      this->Varies_[index] = this->Field_.DirectFluence[index] > 0.0F && depth > 0.0 &&
                             depth < MostPieces * PieceDepth &&
                             (depth > FlatDepth || this->Close(cell));
    }
  }
}

int DirectField::Pieces(std::int64_t cell, double length, int band) const
{
  // Thick pieces are cut: the source is flat in each.
  const double depth =
    this->Scene_.Smoke().Extinction(cell) * this->Scene_.ExtinctionScale(band) * length;
  return std::clamp(static_cast<int>(std::ceil(depth / PieceDepth)), 1, MostPieces);
}

double DirectField::PieceMean(std::int64_t cell, const Vec3& origin, const Vec3& direction,
  double begin, double end, int band) const
{
  const double smooth = this->Smooth(cell, origin + 0.5 * (begin + end) * direction, band);
  return this->Near(cell) ? smooth + this->NearMean(cell, origin, direction, begin, end, band)
                          : smooth;
}

double DirectField::NearMean(std::int64_t cell, const Vec3& origin, const Vec3& direction,
  double begin, double end, int band) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  double sum = 0.0;
  for (const NearLight& near : this->NearCells_[this->NearIndex_[cell]].Lights)
  {
    const std::unique_ptr<NearField>& field = this->NearFields_[near.Light];
    if (!near.Clear || !field)
    {
      // Shadows and sharp beams would cost more than lines are worth.
      sum += near.Mean[band];
      continue;
    }
    const Equiangular places(lights.Groups()[lights.Lights()[near.Light]], origin, direction);
    places.ForEach(begin, end, 0.0,
      [&](double distance, double step)
      { sum += step / (end - begin) * field->Fluence(origin + distance * direction, band); });
  }
  return sum;
}

double DirectField::NearVeil(std::int64_t cell, const Vec3& origin, const Vec3& direction,
  double begin, double end, double extinction, int band) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  double sum = 0.0;
  for (const NearLight& near : this->NearCells_[this->NearIndex_[cell]].Lights)
  {
    const LightGroup& root = lights.Groups()[lights.Lights()[near.Light]];
    const std::unique_ptr<NearField>& field = this->NearFields_[near.Light];
    const Equiangular places(root, origin, direction);
    std::array<double, MostParts + 1> ends;
    const int parts = PartEnds(root, origin, direction, begin, end, extinction, ends);
    for (int part = 0; part < parts; ++part)
    {
      places.ForEach(ends[part], ends[part + 1], extinction,
        [&](double distance, double step)
        {
          const Vec3 point = origin + distance * direction;
          const double fluence = near.Clear && field
                                   ? field->Fluence(point, band)
                                   : this->Direct_.Fluence(near.Light, point, near.Clear)[band];
          sum += fluence * step * extinction * std::exp(-extinction * (distance - begin));
        });
    }
  }
  return sum * this->Scene_.Albedo() / (4.0 * glm::pi<double>());
}

} // namespace smokevis
