#include "DiffusionSides.h"

#include "Scene.h"
#include "Triangle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace smokevis
{

namespace
{

/// Resistance between blocks in nearly clear air, at least: along a whole axis it is less than
/// that of a face, and the equations stay easy to solve.
constexpr double LeastResistance = 0.1;
/// Rows of points that stand for a triangle: as many for the length of a block, and at most in all.
constexpr double PartsAnEdge = 8.0;
constexpr double MostRows = 64.0;
/// Points for all triangles together, about, at most.
constexpr double MostPoints = 4e6;

/// Calls visit(point) for about the centres of rows x rows equal triangles that make one up.
template <class Visit> void ForEachPart(const Triangle& corners, int rows, Visit&& visit)
{
  // Centres themselves often lie right between cells, where rounding would decide.
  constexpr double one = 1.0 / 3.0 + 0.0137;
  constexpr double other = 1.0 / 3.0 + 0.0091;
  const Vec3 along = (corners[1] - corners[0]) / static_cast<double>(rows);
  const Vec3 across = (corners[2] - corners[0]) / static_cast<double>(rows);
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; i + j < rows; ++j)
    {
      visit(corners[0] + (i + one) * along + (j + other) * across);
      if (i + j + 1 < rows)
      {
        visit(corners[0] + (i + 1.0 - one) * along + (j + 1.0 - other) * across);
      }
    }
  }
}

} // namespace

double DiffusionResistance(double depth, double atFaces)
{
  return std::clamp(3.0 * depth, LeastResistance, 4.0 - atFaces);
}

double IncidentShare(double reflectance, double depth)
{
  return 1.0 / (2.0 * (1.0 + reflectance) + DiffusionResistance(depth, 2.0) * (1.0 - reflectance));
}

DiffusionSides::DiffusionSides(const Scene& scene, int band,
  const std::function<std::int32_t(std::size_t, const Vec3&)>& block,
  const std::function<double(std::int32_t, const Vec3&)>& depth, std::size_t blocks, double edge)
    : Absorbed_(blocks, 0.0)
{
  /// Area that lies beside a block, the same times the irradiance over the block's fluence, and
  /// times what the light of the surface itself adds to that.
  struct Bounds
  {
    std::size_t Side;
    std::int32_t Block;
    double Area, Incident, Own;
  };
  std::vector<Bounds> bounds;
  const double triangles =
    static_cast<double>(scene.Surfaces().Triangles.size() + scene.EmitterMesh().Triangles.size());
  const double mostRows = std::clamp(std::floor(std::sqrt(MostPoints / triangles)), 1.0, MostRows);
  const double offset = 10.0 * scene.Shapes().Tolerance();
  // A repeated one may face the other way, and tell of light on a side that none comes to.
  const std::vector<std::vector<Triangle>> patches = TrianglesOfPatches(scene);
  for (std::size_t patch = 0; patch < patches.size(); ++patch)
  {
    for (const Triangle& corners : patches[patch])
    {
      const Vec3 vector = AreaVector(corners);
      const double area = glm::length(vector);
      const int rows = static_cast<int>(
        std::clamp(std::ceil(PartsAnEdge * ReachOf(corners) / edge), 1.0, mostRows));
      for (int which = 0; which < 2; ++which)
      {
        const Vec3 normal = (which == 0 ? 1.0 : -1.0) / area * vector;
        if (!(scene.ExposedArea(patch, which) > 0.0))
        {
          continue;
        }
        const std::size_t side = 2 * patch + which;
        const std::size_t first = bounds.size();
        ForEachPart(corners, rows,
          [&](const Vec3& point)
          {
            const std::int32_t beside = block(side, point + offset * normal);
            if (beside < 0)
            {
              return;
            }
            const double part = area / (static_cast<double>(rows) * rows);
            // Points in a row mostly lie beside one block.
            auto own = std::find_if(bounds.rbegin(), bounds.rend() - first,
              [beside](const Bounds& earlier) { return earlier.Block == beside; });
            if (own == bounds.rend() - first)
            {
              bounds.push_back({side, beside, 0.0, 0.0, 0.0});
              own = bounds.rbegin();
            }
            const double reflectance = scene.PatchReflectance(patch)[band];
            const double toSurface = depth(beside, normal);
            const double share = IncidentShare(reflectance, toSurface);
            own->Area += part;
            own->Incident += part * share;
            own->Own += part * share * reflectance * (DiffusionResistance(toSurface, 2.0) - 2.0);
          });
      }
    }
  }
  std::sort(bounds.begin(), bounds.end(),
    [](const Bounds& a, const Bounds& b)
    { return std::pair(a.Side, a.Block) < std::pair(b.Side, b.Block); });
  this->First_.assign(1, 0);
  auto at = bounds.cbegin();
  for (std::size_t side = 0; side < 2 * scene.Patches(); ++side)
  {
    const double exposed = scene.ExposedArea(side / 2, static_cast<int>(side % 2));
    const double reflectance = scene.PatchReflectance(side / 2)[band];
    const auto end =
      std::find_if(at, bounds.cend(), [&](const Bounds& b) { return b.Side != side; });
    const double area =
      std::accumulate(at, end, 0.0, [](double sum, const Bounds& b) { return sum + b.Area; });
    double sent = 0.0;
    while (at != end)
    {
      const std::int32_t number = at->Block;
      double share = 0.0;
      for (; at != end && at->Block == number; ++at)
      {
        share += at->Incident / area;
        sent += at->Own / area;
      }
      // What the surface sends out comes back to it in part: by Marshak's condition so much stays.
      this->Parts_.push_back({number, static_cast<float>(share),
        static_cast<float>(4.0 * share * reflectance * exposed)});
      this->Absorbed_[number] += share * (1.0 - reflectance) * exposed;
    }
    this->First_.push_back(this->Parts_.size());
    this->Own_.push_back(static_cast<float>(sent));
  }
}

} // namespace smokevis
