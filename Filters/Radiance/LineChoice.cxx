#include "LineChoice.h"

#include "BrightBodies.h"
#include "CellLoops.h"
#include "FirstSource.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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
/// Share of what is sent on at all that patches must send on to get all lines that they need; where
/// it is less, they get fewer, in proportion, and more of them are put together (PatchGroups).
/// Their noise falls with the root of their lines, but what it is a share of falls with the lines.
constexpr double PatchesMatter = 0.02;
/// Below a tolerance so many times as many meet patches, which makes it so much finer, at most.
constexpr double FineTolerance = 0.03;
constexpr double MostTimes = 2.0;
/// How many times the smoke's box the scene's must be for lines through the smoke's alone.
constexpr double InnerRatio = 3.0;
/// How many times as many lines grids need at least that get some of their own.
constexpr double MuchFiner = 2.0;
/// Lines through what is bright over all others, were all light to begin there, at a small
/// tolerance: the light that is sent on there comes to other places along them. Above FineTolerance
/// their share falls with its square: a few sweeps there must be, which bring less noise anyway.
constexpr double BrightLines = 0.5;
/// Lines that join places of the main box, over all others through it: in a corridor's dark layer
/// most noise is that of the few lines which run lengthwise and bring the light of its bright end.
constexpr double LongLines = 0.2;
/// Lines that join places in what glows with places anywhere in the main box, over all others
/// through that, were all light to begin there: of the lines through a flame few run far, fewer
/// still where the air is clearest and its light comes farthest. Above FineTolerance there are
/// fewer: a few sweeps there must be, which bring less noise anyway.
constexpr double GlowLines = 0.5;
/// Share of light inside a body of smoke that is scattered once more, from which on it is so often.
constexpr double OftenShare = 0.7;
/// Extinction coefficient of what belongs to a dense body, over the mean where light is scattered.
constexpr double DenseShare = 0.25;

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

/// The cells of at least some extinction coefficient.
struct Body
{
  Box Bounds = Box::Nothing();
  /// Sums of the extinction coefficient times volume [m2], and of its square times volume [m].
  double Capture = 0.0, Squares = 0.0;

  /// @param least extinction coefficient [1/m]
  static Body Of(const Medium& smoke, double least)
  {
    return ReduceCells(
      smoke.Cells(), Body{},
      [&](Body& body, std::int64_t cell)
      {
        const double extinction = smoke.Extinction(cell);
        const double own = smoke.OwnVolume(cell);
        if (own > 0.0 && extinction >= least)
        {
          body.Bounds.Add(smoke.CellBounds(cell));
          body.Capture += extinction * own;
          body.Squares += extinction * extinction * own;
        }
      },
      [](Body body, const Body& other)
      {
        body.Bounds.Add(other.Bounds);
        body.Capture += other.Capture;
        body.Squares += other.Squares;
        return body;
      });
  }

  /// Optical depth of isotropic chords of the box around it, by Cauchy's formula.
  double MeanDepth() const
  {
    return this->Capture > 0.0 ? 4.0 * this->Capture / this->Bounds.Surface() : 0.0;
  }
};

/// Grids whose cells are about as large.
struct CellGroup
{
  double Cells = 0.0;
  /// Surface of all their cells [m2].
  double Boundary = 0.0;
  std::vector<Box> Boxes;

  /// Lines a unit of surface of a convex body, by Cauchy's formula, that cross a cell often enough.
  double Density() const { return CrossingsPerSweep * this->Cells / this->Boundary; }
};

/// Those of the largest cells first.
std::vector<CellGroup> CellGroups(const Medium& smoke)
{
  std::vector<CellGroup> grids;
  for (const Medium::Block& grid : smoke.Blocks(std::numeric_limits<int>::max()))
  {
    CellGroup& own = grids.emplace_back();
    own.Cells = static_cast<double>(grid.Cells());
    grid.ForEachCell([&](const std::array<int, 3>& place)
      { own.Boundary += BoxSurface(smoke.CellSize(smoke.Cell(grid, place))); });
    own.Boxes.push_back(smoke.BoxOf(smoke.Cell(grid, {0, 0, 0})));
    own.Boxes.back().Add(
      smoke.BoxOf(smoke.Cell(grid, {grid.Size[0] - 1, grid.Size[1] - 1, grid.Size[2] - 1})));
  }
  std::sort(grids.begin(), grids.end(),
    [](const CellGroup& a, const CellGroup& b) { return a.Density() < b.Density(); });
  std::vector<CellGroup> groups;
  double least = 0.0;
  for (const CellGroup& grid : grids)
  {
    if (groups.empty() || grid.Density() > MuchFiner * least)
    {
      groups.emplace_back();
      least = grid.Density();
    }
    CellGroup& group = groups.back();
    group.Cells += grid.Cells;
    group.Boundary += grid.Boundary;
    group.Boxes.insert(group.Boxes.end(), grid.Boxes.begin(), grid.Boxes.end());
  }
  return groups;
}

/// Share of all that is sent on which patches send on: of direct light, or of light that is even
/// everywhere, whichever is more.
double SentByPatches(const Scene& scene, const LightField& field, int band)
{
  const Medium& smoke = scene.Smoke();
  const EmitterSet& lights = scene.Lights();
  bool known = !(scene.Sky() > 0.0) && !smoke.Emits();
  for (std::size_t cell = 0; cell < lights.Cells().size(); ++cell)
  {
    known = known && !lights.LeftToLines(cell);
  }
  if (!known)
  {
    // Nobody knows yet where that light comes to.
    return 1.0;
  }
  const auto shareOf = [](double patches, double other)
  { return patches > 0.0 ? patches / (patches + other) : 0.0; };
  const FirstSource direct(scene, field, band);
  // Even light brings a quarter of its fluence to any surface, that of the smoke's box too, which
  // smoke sends no more out through.
  double reflected = 0.0;
  for (std::size_t side = 0; side < 2 * scene.Patches(); ++side)
  {
    reflected += 0.25 * scene.PatchReflectance(side / 2)[band] *
                 scene.ExposedArea(side / 2, static_cast<int>(side % 2));
  }
  const Body body = Body::Of(smoke, 0.0);
  const double scattered = body.Capture > 0.0
                             ? std::min(scene.Albedo() * scene.ExtinctionScale(band) * body.Capture,
                                 0.25 * body.Bounds.Surface())
                             : 0.0;
  return std::max(shareOf(direct.OfPatches(), direct.OfSmoke()), shareOf(reflected, scattered));
}

} // namespace

std::vector<Box> PatchBounds(const Scene& scene)
{
  std::vector<Box> bounds(scene.Patches(), Box::Nothing());
  scene.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners) { bounds[patch].Add(BoundsOf(corners)); });
  return bounds;
}

double CellMeetings(const GlobalLines& lines, const Medium& smoke, std::int64_t cell)
{
  const Box bounds = smoke.CellBounds(cell);
  return lines.Meetings(bounds.Surface(), bounds);
}

bool ScattersOften(const Scene& scene, int band)
{
  const Medium& smoke = scene.Smoke();
  const Body whole = Body::Of(smoke, 0.0);
  // A cloud in much clear air counts for itself.
  const Body dense =
    Body::Of(smoke, whole.Capture > 0.0 ? DenseShare * whole.Squares / whole.Capture : 0.0);
  const double depth = scene.ExtinctionScale(band) * std::max(whole.MeanDepth(), dense.MeanDepth());
  // The share that is not scattered again is about 1 / (1 + depth) (Wigner's rational
  // approximation).
  return scene.Albedo() * depth / (1.0 + depth) > OftenShare;
}

GlobalLines ChooseLines(const Scene& scene, const LightField& field, int band, double tolerance)
{
  const Medium& smoke = scene.Smoke();
  const double meetings = CrossingsPerSweep * std::clamp(FineTolerance / tolerance, 1.0, MostTimes);
  const auto count = [](double lines)
  { return GlobalLines::AtLeast(std::max(FewestLines, lines)); };
  std::vector<CellGroup> groups = CellGroups(smoke);
  const double density = groups.empty() ? 0.0 : groups.front().Density();
  const Box box = SceneBox(scene);
  const double margin = 1e-4 * glm::length(smoke.Upper() - smoke.Lower());
  const auto within = [&](const Box& part) {
    return Box{glm::max(box.Lower, part.Lower - margin), glm::min(box.Upper, part.Upper + margin)};
  };
  const Box inner = within({smoke.Lower(), smoke.Upper()});
  std::vector<bool> inside(scene.Patches(), true);
  const bool divided = !smoke.Empty() && box.Surface() >= InnerRatio * inner.Surface();
  if (divided)
  {
    const std::vector<Box> bounds = PatchBounds(scene);
    std::transform(bounds.begin(), bounds.end(), inside.begin(),
      [&](const Box& patch) { return inner.Contains(patch.Lower) && inner.Contains(patch.Upper); });
  }
  const Box& main = divided ? inner : box;
  // Outside of the smoke there is nothing else.
  const double needed = std::min(1.0, SentByPatches(scene, field, band) / PatchesMatter);
  const std::size_t mainLines = count(std::max(
    density * main.Surface(), needed * LinesForPatches(scene, band, meetings, main, inside)));
  inside.flip();
  GlobalLines lines(
    box, divided ? count(LinesForPatches(scene, band, meetings, box, inside)) : mainLines);
  if (divided)
  {
    lines.AddInner(inner, mainLines);
  }
  const auto addThrough = [&](const Box& part, double wanted)
  {
    // Other boxes hold it whole where only roundings stick out.
    const Box core{part.Lower + margin, part.Upper - margin};
    const double lacking = wanted - lines.Meetings(part.Surface(), core);
    if (lacking > 0.0)
    {
      lines.AddInner(within(part), GlobalLines::AtLeast(lacking));
    }
  };
  for (std::size_t i = 1; i < groups.size(); ++i)
  {
    JoinWhereSmaller(
      groups[i].Boxes, [](const Box& part) -> const Box& { return part; },
      [](Box& part, const Box& other) { part.Add(other); });
    for (const Box& part : groups[i].Boxes)
    {
      addThrough(part, groups[i].Density() * part.Surface());
    }
  }
  const double fine = std::min(1.0, FineTolerance / tolerance);
  const double bright = BrightLines * fine * fine * static_cast<double>(mainLines);
  for (const BrightBody& body : BrightBodies(scene, field, band, box))
  {
    addThrough(body.Bounds, bright * body.Share);
  }
  lines.AddJoining(main, main, GlobalLines::AtLeast(LongLines * static_cast<double>(mainLines)));
  const double glowing = GlowLines * fine * static_cast<double>(mainLines);
  for (const BrightBody& body : GlowingBodies(scene, field, band, box))
  {
    // Of what fills the box, other lines tell as much.
    const Box part = within(body.Bounds);
    const double rest = 1.0 - part.Volume() / main.Volume();
    if (rest > 0.0)
    {
      lines.AddJoining(part, main, GlobalLines::AtLeast(glowing * body.Share * rest));
    }
  }
  return lines;
}

} // namespace smokevis
