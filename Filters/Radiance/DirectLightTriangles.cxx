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
/// Above this share six points serve, exact for a polynomial of fourth degree, else three, exact
/// for a quadratic (Strang and Fix 1973; Dunavant 1985): where they lie between a corner and the
/// centre, and their weights.
constexpr double SixPointRatio = 0.2;
constexpr std::array<double, 1> ThreePoints = {0.5};
constexpr std::array<double, 1> ThreeWeights = {1.0 / 3.0};
constexpr std::array<double, 2> SixPoints = {0.7252713594706870, -0.3378454727478950};
constexpr std::array<double, 2> SixWeights = {0.109951743655322, 0.223381589678011};
constexpr int MostSplits = 14;
/// How often one is split, in all, that the edge of a shadow runs through.
constexpr int ShadowSplits = 4;
/// The same where that may only be: a grid throws many shadows.
constexpr int AlikeSplits = 2;

/// What lies before the plane of a plate of a triangle that it cuts, in one or two triangles.
struct Front
{
  std::array<Triangle, 2> Parts;
  int Count = 1;
};

Front FrontOf(const LightGroup& root, const Triangle& corners, double tolerance)
{
  Front front{{corners, corners}};
  std::array<double, 3> heights;
  std::transform(corners.begin(), corners.end(), heights.begin(),
    [&root](const Vec3& corner) { return glm::dot(corner - root.Centre, root.Normal); });
  const auto [lowest, highest] = std::minmax({heights[0], heights[1], heights[2]});
  if (!root.Plane() || lowest >= -tolerance || highest <= tolerance)
  {
    return front;
  }
  std::array<Vec3, 4> polygon;
  int count = 0;
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    if (heights[i] >= 0.0)
    {
      polygon[count++] = corners[i];
    }
    if ((heights[i] < 0.0) != (heights[next] < 0.0))
    {
      polygon[count++] =
        glm::mix(corners[i], corners[next], heights[i] / (heights[i] - heights[next]));
    }
  }
  front.Count = count - 2;
  front.Parts = {Triangle{polygon[0], polygon[1], polygon[2]},
    Triangle{polygon[0], polygon[2], polygon[count - 1]}};
  return front;
}

} // namespace

std::array<Spectrum, 2> DirectLight::TriangleIlluminance(
  std::size_t light, const Triangle& corners, const Vec3& normal) const
{
  const Front front =
    FrontOf(this->Scene_.Lights().Root(light), corners, this->Scene_.Shapes().Tolerance());
  const double area = AreaOf(corners);
  LitTriangle whole{light, CentreOf(corners), normal};
  for (int part = 0; part < front.Count; ++part)
  {
    this->AddTriangle(whole, front.Parts[part], 0, AreaOf(front.Parts[part]) / area);
  }
  return whole.Sum;
}

void DirectLight::AddPlace(LitTriangle& whole, const Vec3& point, double weight, bool clear) const
{
  const LightGroup& root = this->Scene_.Lights().Root(whole.Light);
  Receiver receiver{point, std::nullopt, clear};
  this->WalkFar(root, receiver);
  for (int face = 0; face < 2; ++face)
  {
    // Light comes from one side of the triangle's plane, unless the plane cuts the emitter.
    receiver.Normal = face == 0 ? whole.Normal : -whole.Normal;
    if (glm::dot(root.Centre - point, *receiver.Normal) <= -root.Radius)
    {
      continue;
    }
    Spectrum value = this->Fluence(whole.Light, receiver);
    if (!whole.Uneven && IsLit(value))
    {
      whole.Uneven = this->WaysAcross(whole.Light, whole.Centre, {}).has_value();
    }
    if (whole.Uneven.value_or(false))
    {
      this->DimUnevenly(whole.Light, receiver, value);
    }
    Accumulate(whole.Sum[face], value, weight);
  }
}

void DirectLight::AddTriangle(
  LitTriangle& whole, const Triangle& corners, int level, double weight) const
{
  const LightGroup& root = this->Scene_.Lights().Root(whole.Light);
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
  const double reach = ReachOf(corners);
  const double coarseness = root.Law.Coarseness(highest + root.Depth, distance - reach);
  const double size = reach * root.Law.Sharpness() / coarseness;
  const auto splitAll = [&]
  {
    const std::array<Vec3, 3> middle = {0.5 * (corners[0] + corners[1]),
      0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0])};
    const double quarter = 0.25 * weight;
    this->AddTriangle(whole, {corners[0], middle[0], middle[2]}, level + 1, quarter);
    this->AddTriangle(whole, {middle[0], corners[1], middle[1]}, level + 1, quarter);
    this->AddTriangle(whole, {middle[2], middle[1], corners[2]}, level + 1, quarter);
    this->AddTriangle(whole, middle, level + 1, quarter);
  };
  const double plate = PlateShare * root.Radius * root.Law.Sharpness();
  if (level < MostSplits && size > TriangleRatio * std::max(distance, plate))
  {
    splitAll();
    return;
  }
  if (size < (level == 0 ? TrianglePointRatio : PartPointRatio) * distance)
  {
    // It tells of itself whether the light is dimmed unevenly.
    whole.Uneven = level == 0 ? std::optional(true) : whole.Uneven;
    this->AddPlace(whole, centre, weight, false);
    return;
  }
  std::array<std::vector<bool>, 3> seen;
  std::transform(corners.begin(), corners.end(), seen.begin(),
    [&](const Vec3& corner)
    { return this->Sight_.SeenOfAll(root, glm::mix(centre, corner, ThreePoints[0])); });
  // Where the same places are seen from all points, as of a lamp that is sunk into a wall, hardly
  // an edge of a shadow runs through the triangle.
  const bool alike = seen[0] == seen[1] && seen[0] == seen[2];
  const Sight sight = LightSight::OfSeen(seen[0]);
  if (alike && sight == Sight::None)
  {
    return;
  }
  const bool clear = alike && sight == Sight::Whole;
  if (!clear && level < (alike ? AlikeSplits : ShadowSplits))
  {
    splitAll();
    return;
  }
  const auto addAll = [&](const auto& points, const auto& weights)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (const Vec3& corner : corners)
      {
        this->AddPlace(whole, glm::mix(centre, corner, points[i]), weight * weights[i], clear);
      }
    }
  };
  if (clear && size > SixPointRatio * distance)
  {
    addAll(SixPoints, SixWeights);
  }
  else
  {
    addAll(ThreePoints, ThreeWeights);
  }
}

} // namespace smokevis
