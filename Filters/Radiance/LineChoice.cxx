#include "LineChoice.h"

#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace smokevis
{

namespace
{

/// How often a sweep's lines cross each cell and meet each patch, and how many there are at least,
/// and at most for patches.
constexpr double CrossingsPerSweep = 1.5;
constexpr double FewestLines = 512.0;
constexpr double MostLinesForPatches = 20000.0;
/// Below a tolerance so many times as many meet patches, which makes it so much finer, at most.
constexpr double FineTolerance = 0.03;
constexpr double MostTimes = 2.0;
/// How many times the smoke's box the scene's must be for lines through the smoke's alone.
constexpr double InnerRatio = 3.0;
/// Share of light inside a body of smoke that is scattered once more, from which on it is so often.
constexpr double OftenShare = 0.75;

/// The box around the scene, somewhat larger: surfaces on its border lie inside.
Box SceneBox(const Scene& scene)
{
  const double margin = 1e-4 * glm::length(scene.Upper() - scene.Lower());
  return {scene.Lower() - margin, scene.Upper() + margin};
}

/// How many lines through a box patches need, where surfaces send light on or out.
/// @param meetings of each patch, in the mean
/// @param serves which patches count
double LinesForPatches(
  const Scene& scene, int band, double meetings, const Box& box, const std::vector<bool>& serves)
{
  double area = 0.0;
  // The cells of a sign share their indirect light.
  std::map<int, double> cellsOfSign;
  for (const EmitterCell& cell : scene.Lights().Cells())
  {
    cellsOfSign[cell.SignId] += 1.0;
  }
  double reflecting = 0.0;
  for (std::size_t patch = 0; patch < scene.Patches(); ++patch)
  {
    if (serves[patch] && (scene.PatchReflectance(patch)[band] > 0.0 || scene.Sky() > 0.0))
    {
      area += scene.PatchArea(patch);
      const int sign = patch < scene.SurfacePatches()
                         ? -1
                         : scene.Lights().Cells()[patch - scene.SurfacePatches()].SignId;
      reflecting += sign < 0 ? 1.0 : 1.0 / cellsOfSign[sign];
    }
  }
  // Patches that are tiny against the box are not worth a flood of lines.
  return area > 0.0
           ? std::min(meetings * reflecting * box.Surface() / (2.0 * area), MostLinesForPatches)
           : 0.0;
}

} // namespace

std::vector<bool> PatchesIn(const Scene& scene, const Box& box)
{
  std::vector<bool> inside(scene.Patches(), true);
  scene.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners)
    {
      for (const Vec3& corner : corners)
      {
        inside[patch] = inside[patch] && box.Contains(corner);
      }
    });
  return inside;
}

bool ScattersOften(const Scene& scene, int band)
{
  const Medium& smoke = scene.Smoke();
  if (smoke.Empty())
  {
    return false;
  }
  double depth = 0.0;
  for (std::size_t i = 0; i < smoke.Cells(); ++i)
  {
    const auto cell = static_cast<std::int64_t>(i);
    depth += smoke.Extinction(cell) * smoke.OwnVolume(cell);
  }
  // Mean optical depth of isotropic chords, by Cauchy's formula; the share that is not scattered
  // again is about 1 / (1 + depth) (Wigner's rational approximation).
  depth *= 4.0 * scene.ExtinctionScale(band) / BoxSurface(smoke.Upper() - smoke.Lower());
  return scene.Albedo() * depth / (1.0 + depth) > OftenShare;
}

GlobalLines ChooseLines(const Scene& scene, int band, double tolerance)
{
  const Medium& smoke = scene.Smoke();
  const double meetings = CrossingsPerSweep * std::clamp(FineTolerance / tolerance, 1.0, MostTimes);
  double boundary = 0.0;
  for (std::size_t cell = 0; cell < smoke.Cells(); ++cell)
  {
    boundary += BoxSurface(smoke.CellSize(static_cast<std::int64_t>(cell)));
  }
  const auto count = [](double lines)
  { return static_cast<std::size_t>(std::ceil(std::max(FewestLines, lines))); };
  const Box box = SceneBox(scene);
  // By Cauchy's formula a line meets a convex body in proportion to its surface.
  const double linesPerArea =
    boundary > 0.0 ? CrossingsPerSweep * static_cast<double>(smoke.Cells()) / boundary : 0.0;
  const double margin = 1e-4 * glm::length(smoke.Upper() - smoke.Lower());
  const Box inner = {
    glm::max(box.Lower, smoke.Lower() - margin), glm::min(box.Upper, smoke.Upper() + margin)};
  if (smoke.Empty() || box.Surface() < InnerRatio * inner.Surface())
  {
    const std::vector<bool> all(scene.Patches(), true);
    return {box, count(std::max(linesPerArea * box.Surface(),
                   LinesForPatches(scene, band, meetings, box, all)))};
  }
  std::vector<bool> inside = PatchesIn(scene, inner);
  const double forInside = LinesForPatches(scene, band, meetings, inner, inside);
  inside.flip();
  GlobalLines lines(box, count(LinesForPatches(scene, band, meetings, box, inside)));
  lines.AddInner(inner, count(std::max(linesPerArea * inner.Surface(), forInside)));
  return lines;
}

} // namespace smokevis
