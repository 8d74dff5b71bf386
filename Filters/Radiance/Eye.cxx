#include "Eye.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{
namespace
{

constexpr double Pi = 3.141592653589793;
/// Groups of emitting cells that span less than this count as one source [rad].
constexpr double SmallAngle = 0.05;
/// Larger ones without cells of their own are cut, at most into so many parts along an edge.
constexpr int MostParts = 12;

/// Parts of an edge that a point at a distance sees under a small angle each.
int PartsOf(double edge, double distance)
{
  // A part's radius is about half its edge times the root of 2.
  const double parts = std::ceil(edge / (std::sqrt(2.0) * SmallAngle * std::max(distance, 1e-9)));
  return static_cast<int>(std::clamp(parts, 1.0, static_cast<double>(MostParts)));
}

} // namespace

//------------------------------------------------------------------------------
double AdaptationLuminance(double luminance, double time)
{
  return 0.05 * luminance * std::pow(1.9 + time, -1.4);
}

//------------------------------------------------------------------------------
double VeilPerIlluminance(double angle, double age)
{
  const double degrees = std::max(0.1, angle * 180.0 / Pi);
  if (degrees > 100.0)
  {
    return 0.0;
  }
  const double ageing = 1.0 + std::pow(age / 62.5, 4.0);
  return 10.0 / (degrees * degrees * degrees) +
         (5.0 / (degrees * degrees) + 0.05 / degrees) * ageing + 0.00125;
}

//------------------------------------------------------------------------------
double VisibleProbability(double contrast, double threshold, double spread)
{
  if (!(spread > 0.0))
  {
    return contrast >= threshold ? 1.0 : 0.0;
  }
  return 0.5 * std::erfc((threshold - contrast) / (spread * std::sqrt(2.0)));
}

//------------------------------------------------------------------------------
GlareSources::GlareSources(const View& view, const Vec3& eye) : Eye_(eye)
{
  const EmitterSet& lights = view.TheScene().Lights();
  std::vector<int> open = lights.Lights();
  while (!open.empty())
  {
    const LightGroup& group = lights.Groups()[open.back()];
    open.pop_back();
    if (group.FirstChild >= 0 && group.Radius > SmallAngle * glm::distance(group.Centre, eye))
    {
      open.push_back(group.FirstChild);
      open.push_back(group.FirstChild + 1);
      continue;
    }
    if (group.Radius > SmallAngle * glm::distance(group.Centre, eye))
    {
      this->AddParts(view, group);
      continue;
    }
    this->AddPlate(
      view, group.Centre, group.Radius, group.Normal, group.Law, group.Intensity, group.SignId);
  }
  for (std::size_t cell = 0; cell < lights.Cells().size(); ++cell)
  {
    if (lights.LeftToLines(cell))
    {
      Spectrum intensity = lights.Cells()[cell].Luminance;
      for (double& value : intensity)
      {
        value *= lights.CellArea(cell);
      }
      this->AddPlate(view, lights.CellCentre(cell), std::sqrt(lights.CellArea(cell) / Pi),
        lights.CellNormal(cell), lights.CellLaw(cell), intensity, lights.Cells()[cell].SignId);
    }
  }
  if (view.TheScene().Smoke().Emits())
  {
    this->AddFlames(view);
  }
}

//------------------------------------------------------------------------------
void GlareSources::AddParts(const View& view, const LightGroup& leaf)
{
  const auto& corners = leaf.Corners;
  const double distance = leaf.Distance(this->Eye_);
  const int across =
    PartsOf(std::max(glm::distance(corners[0], corners[1]), glm::distance(corners[3], corners[2])),
      distance);
  const int up =
    PartsOf(std::max(glm::distance(corners[0], corners[3]), glm::distance(corners[1], corners[2])),
      distance);
  for (int j = 0; j < up; ++j)
  {
    for (int i = 0; i < across; ++i)
    {
      const auto at = [&](double right, double above)
      { return leaf.At((i + right) / across, (j + above) / up); };
      const double area =
        0.5 * glm::length(glm::cross(at(1.0, 1.0) - at(0.0, 0.0), at(0.0, 1.0) - at(1.0, 0.0)));
      Spectrum intensity = leaf.Intensity;
      for (double& value : intensity)
      {
        value *= area / leaf.Area;
      }
      this->AddPlate(
        view, at(0.5, 0.5), std::sqrt(area / Pi), leaf.Normal, leaf.Law, intensity, leaf.SignId);
    }
  }
}

//------------------------------------------------------------------------------
void GlareSources::AddPlate(const View& view, const Vec3& place, double radius, const Vec3& normal,
  const EmissionLaw& law, const Spectrum& intensity, int signId)
{
  const Scene& scene = view.TheScene();
  const Vec3 way = place - this->Eye_;
  const double distance = glm::length(way);
  const double cosine = -glm::dot(way, normal) / distance;
  if (!(cosine > 0.0) || !scene.Shapes().Visible(this->Eye_, place))
  {
    return;
  }
  const double depth = scene.Smoke().OpticalDepth(this->Eye_, way / distance, 0.0, distance);
  Spectrum arriving{};
  for (int band = 0; band < scene.Bands(); ++band)
  {
    arriving[band] = intensity[band] * std::exp(-scene.ExtinctionScale(band) * depth);
  }
  // A disc on the axis, exact there and finite close by.
  const double square = distance * distance + radius * radius;
  const double illuminance =
    Luminance(arriving, scene.Bands()) * cosine * law.Relative(-way / distance, cosine) / square;
  if (illuminance > 0.0)
  {
    this->Sources_.push_back({way / distance, std::atan2(radius, distance), illuminance, signId});
  }
}

//------------------------------------------------------------------------------
void GlareSources::AddFlames(const View& view)
{
  const Scene& scene = view.TheScene();
  const Medium& smoke = scene.Smoke();
  for (std::size_t index = 0; index < smoke.Cells(); ++index)
  {
    const auto cell = static_cast<std::int64_t>(index);
    const double luminance = smoke.EmittedLuminance(cell);
    if (!(luminance > 0.0) || !(smoke.Extinction(cell) > 0.0F))
    {
      continue;
    }
    const Vec3 way = smoke.CellCentre(cell) - this->Eye_;
    const double distance = glm::length(way);
    const Vec3 size = smoke.CellSize(cell);
    const Vec3 across = glm::abs(way) / std::max(distance, 1e-300);
    // What the eye sees of the cell [m2], and its depth along the line of sight.
    const double area =
      across.x * size.y * size.z + across.y * size.z * size.x + across.z * size.x * size.y;
    const double chord = size.x * size.y * size.z / area;
    const double half =
      0.5 * std::min({size.x / std::max(across.x, 1e-9), size.y / std::max(across.y, 1e-9),
              size.z / std::max(across.z, 1e-9)});
    const double square = area / Pi;
    if (!(distance > 0.0) || !scene.Shapes().Visible(this->Eye_, smoke.CellCentre(cell)))
    {
      continue;
    }
    // Smoke before the cell's middle dims it, and the cell itself its own far side.
    const double before =
      smoke.OpticalDepth(this->Eye_, way / distance, 0.0, std::max(0.0, distance - half));
    Spectrum arriving{};
    for (int band = 0; band < scene.Bands(); ++band)
    {
      const double scale = scene.ExtinctionScale(band);
      const double thickness = scale * smoke.Extinction(cell) * chord;
      arriving[band] = (1.0 - scene.Albedo()) * luminance * area * -std::expm1(-thickness) *
                       std::exp(-scale * before);
    }
    const double illuminance = Luminance(arriving, scene.Bands()) / (distance * distance + square);
    this->Sources_.push_back(
      {way / distance, std::atan2(std::sqrt(square), distance), illuminance, -1});
  }
}

//------------------------------------------------------------------------------
double GlareSources::VeilingLuminance(const Sign& sign, double age) const
{
  const Vec3 sight = glm::normalize(sign.Centre - this->Eye_);
  double veil = 0.0;
  for (const Source& source : this->Sources_)
  {
    const double cosine = glm::dot(source.Direction, sight);
    if (!(cosine > 0.0) || source.SignId == sign.Id)
    {
      continue;
    }
    const double angle = std::atan2(glm::length(glm::cross(source.Direction, sight)), cosine);
    // Not nearer than half its radius: a source that the eye looks into stays finite, and one
    // beside the line of sight is hardly moved.
    const double off = std::hypot(angle, 0.5 * source.Radius);
    veil += source.Illuminance * cosine * VeilPerIlluminance(off, age);
  }
  return veil;
}

//------------------------------------------------------------------------------
Observer LookingAt(
  const Observer& rested, const Adaptation& state, const GlareSources* sources, const Sign& sign)
{
  Observer observer = rested;
  observer.DarkLuminance += AdaptationLuminance(state.Luminance, state.Time);
  if (sources)
  {
    observer.DarkLuminance += sources->VeilingLuminance(sign, state.Age);
  }
  return observer;
}

} // namespace smokevis
