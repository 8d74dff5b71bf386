// DirectLight's part for surfaces: means over the two sides of a triangle.
#include "DirectLight.h"

#include "Scene.h"

#include <algorithm>

namespace smokevis
{

namespace
{

/// A triangle as large as this share of its distance to the light is split, as often as it takes;
/// right before a plate light changes over some share of the plate's size. Below the smaller share
/// one point does; of the parts of a triangle that a shadow's edge runs through, below the
/// smallest.
constexpr double TriangleRatio = 0.5;
constexpr double PlateShare = 0.25;
constexpr double TrianglePointRatio = 0.1;
constexpr double PartPointRatio = 0.025;
constexpr int MostSplits = 14;
/// How often one is split, in all, that the edge of a shadow runs through.
constexpr int ShadowSplits = 4;

} // namespace

std::array<Spectrum, 2> DirectLight::TriangleIlluminance(
  std::size_t light, const Triangle& corners, const Vec3& normal) const
{
  std::array<Spectrum, 2> sum{};
  this->AddTriangle(light, corners, normal, 0, 1.0, sum);
  return sum;
}

void DirectLight::AddTriangle(std::size_t light, const Triangle& corners, const Vec3& normal,
  int level, double weight, std::array<Spectrum, 2>& sum) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const Vec3 centre = CentreOf(corners);
  const double distance = root.Distance(centre);
  // What does not reach before the light gets nothing from it: so do the light's own cells, and the
  // wall that it is on.
  const auto height = [&root](const Vec3& corner)
  { return glm::dot(corner - root.Centre, root.Normal); };
  const double highest = std::max({height(corners[0]), height(corners[1]), height(corners[2])});
  if (highest <= this->Scene_.Shapes().Tolerance() - root.Depth)
  {
    return;
  }
  const double size = ReachOf(corners) * root.Law.Sharpness();
  const auto splitAll = [&]
  {
    const std::array<Vec3, 3> middle = {0.5 * (corners[0] + corners[1]),
      0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0])};
    const double quarter = 0.25 * weight;
    this->AddTriangle(light, {corners[0], middle[0], middle[2]}, normal, level + 1, quarter, sum);
    this->AddTriangle(light, {middle[0], corners[1], middle[1]}, normal, level + 1, quarter, sum);
    this->AddTriangle(light, {middle[2], middle[1], corners[2]}, normal, level + 1, quarter, sum);
    this->AddTriangle(light, middle, normal, level + 1, quarter, sum);
  };
  const double plate = PlateShare * root.Radius * root.Law.Sharpness();
  if (level < MostSplits && size > TriangleRatio * std::max(distance, plate))
  {
    splitAll();
    return;
  }
  // Three points are exact for a quadratic (Strang and Fix).
  std::array<Vec3, 3> points;
  const int count = size < (level == 0 ? TrianglePointRatio : PartPointRatio) * distance ? 1 : 3;
  for (int i = 0; i < count; ++i)
  {
    points[i] = count == 1 ? centre : 0.5 * (centre + corners[i]);
  }
  bool clear = false;
  if (count > 1)
  {
    double least = 1.0;
    double most = 0.0;
    for (int i = 0; i < count; ++i)
    {
      const double share = this->VisibleShare(root, points[i]);
      least = std::min(least, share);
      most = std::max(most, share);
    }
    if (most == 0.0)
    {
      return;
    }
    clear = least == 1.0;
    if (!clear && level < ShadowSplits)
    {
      // The edge of a shadow runs through the triangle.
      splitAll();
      return;
    }
  }
  for (int face = 0; face < 2; ++face)
  {
    for (int i = 0; i < count; ++i)
    {
      // Light comes from one side of the triangle's plane, unless the plane cuts the emitter.
      const double side = glm::dot(root.Centre - points[i], normal);
      if ((face == 0 ? side : -side) <= -root.Radius)
      {
        continue;
      }
      const Spectrum value =
        this->Illuminance(light, points[i], face == 0 ? normal : -normal, clear);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        sum[face][band] += weight / count * value[band];
      }
    }
  }
}

} // namespace smokevis
