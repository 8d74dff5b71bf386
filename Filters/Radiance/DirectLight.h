// Light that reaches points, smoke cells and surface patches straight from the emitters.
#pragma once

#include "LightSight.h"
#include "LightWays.h"
#include "Medium.h"
#include "Triangle.h"
#include "Types.h"

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace smokevis
{

class CellsAround;
class ClearBorders;
class NearField;
class NearLights;
class Scene;
struct LightGroup;

/// Next-event estimation without noise: the solid angle of the emitter is exact, the transmittance
/// is exact along lines to it, and both are refined where the emitter is close.
class DirectLight
{
public:
  /// Above this tolerance light near to lamps is known to two percent only (Scene::Near): veils are
  /// noisier.
  static constexpr double FineTolerance = 0.05;

  /// @param near what is known of lights near to cells already; must outlive this
  /// @param tolerance that is asked for; a large one lets few ways stand for many sooner
  explicit DirectLight(
    const Scene& scene, const NearLights* near = nullptr, double tolerance = 0.0);

  /// Fluence at a point from one light (index into EmitterSet::Lights) [lx].
  /// @param clear whether it is known that nothing hides the light from there
  Spectrum Fluence(std::size_t light, const Vec3& point, bool clear = false) const;
  /// Whether the corners and the centre of a smoke cell, or the samples of its part, all see the
  /// whole of a light.
  bool Clear(std::size_t light, std::int64_t cell) const;
  /// Whether nothing reaches into the convex hull of a light's plane plate and what lies before it
  /// of a smoke cell; not where that is no box.
  bool ClearBefore(std::size_t light, std::int64_t cell) const;
  /// Illuminance at a point of a surface with a unit normal [lx].
  Spectrum Illuminance(std::size_t light, const Vec3& point, const Vec3& normal) const;
  /// Mean fluence over a part of a cell that walls cut [lx].
  Spectrum PartFluence(std::size_t light, const CellPart& part) const;
  /// Mean fluence over a smoke cell, or the part with this number, of a light near to it [lx].
  /// @param clear whether nothing hides it from the cell
  /// @param kept its fluence around it, or none
  Spectrum NearCellFluence(
    std::size_t light, std::int64_t cell, bool clear, const NearField* kept) const;
  /// How the cells of a block came by a light's fluence.
  struct BlockWork
  {
    /// Their ways were told by others'.
    std::size_t Told = 0;
    /// So were the ways from cells around the block, which tell how light changes in it.
    std::size_t ToldAround = 0;
    /// What uneven smoke makes of a far light was told by other cells.
    std::size_t ToldUneven = 0;
    /// They see nothing of it.
    std::size_t Unseen = 0;
    /// They were left out: the light adds less there than single precision shows.
    std::size_t Negligible = 0;

    BlockWork& operator+=(const BlockWork& other)
    {
      this->Told += other.Told;
      this->ToldAround += other.ToldAround;
      this->ToldUneven += other.ToldUneven;
      this->Unseen += other.Unseen;
      this->Negligible += other.Negligible;
      return *this;
    }
  };
  /// Adds a light's mean fluence in the cells of a block [lx]. Ways from afar to neighbouring cells
  /// are much the same: where a few of them tell the rest, they do.
  /// @param borders of the block
  /// @param sums of all cells of the smoke; the strongest lights should come first, since what the
  /// sums hold bounds what is negligible
  /// @param skips whether ways are told and negligible lights left out
  BlockWork AddBlockFluence(std::size_t light, const CellsAround& around,
    const ClearBorders& borders, bool skips, std::vector<Spectrum>& sums) const;
  /// Mean illuminance of a triangle's front and back [lx].
  std::array<Spectrum, 2> TriangleIlluminance(
    std::size_t light, const Triangle& corners, const Vec3& normal) const;

private:
  /// One way stands for all ways to a group of radius r at a distance d below this r/d; above it
  /// each Gauss point of a leaf has its own.
  static constexpr double PathRatio = 0.1;
  /// A leaf of a light is split above this r/d, where three Gauss points an edge do not follow its
  /// transmittance any more.
  static constexpr double LeafRatio = 0.7;
  /// A box as large as this share of its distance to the light is split, so often at most.
  static constexpr double BoxRatio = 0.5;
  static constexpr int BoxSplits = 3;
  /// Cells are often just as deep as what follows: somewhat more, or rounding would decide.
  static constexpr double Aside = 1.0 + 1e-6;
  /// A box of a larger optical depth (times up to two at a large tolerance), or larger share of its
  /// distance, is measured at Gauss points: two along each edge follow an exponential over a depth
  /// x to x^4 / 4320 and 1 / d^2 over a share x of the distance to x^4 / 36; three go farther.
  /// Above the deepest nearly all light stays in the first part of the box.
  static constexpr double FlatDepth = 0.25 * Aside;
  static constexpr double FlatRatio = 0.2 * Aside;
  static constexpr double TwoPointDepth = 1.2 * Aside;
  static constexpr double TwoPointRatio = 0.25 * Aside;
  static constexpr double DeepestGauss = 4.0 * Aside;

  /// Light that is dimmed by this optical depth is beyond single precision: it needs no shadows.
  static constexpr double DeepestDepth = 100.0;

  /// Mean extinction along the ways from one point to the places of a light's plate, at 633 nm
  /// [1/m]: a polynomial through three by three of them.
  struct Ways
  {
    Vec3 Corner{0.0};
    /// Edges of the plate over the squares of their lengths.
    Vec3 Along{0.0}, Up{0.0};
    /// Factors[j][i] is that of v^j u^i, where u and v are shares of the edges.
    std::array<std::array<double, 3>, 3> Factors{};
    /// The smallest and the largest of the nine.
    double Least = std::numeric_limits<double>::infinity();
    double Most = 0.0;

    double At(const Vec3& place) const;
  };
  struct Receiver
  {
    Vec3 Point;
    /// Of a surface; for smoke there is none.
    std::optional<Vec3> Normal;
    /// Nothing hides the light.
    bool Clear = false;
    /// Where the plate is close and few ways to it tell all others.
    std::optional<Ways> Close{};
    /// Where the light is far: the mean extinction along all ways to it, if that is known [1/m].
    std::optional<double> Extinction{};
    /// Whether its horizon may cut leaves of a light: else they lie above it.
    bool Cuts = true;
  };
  /// What the way to a light does to its light.
  struct Path
  {
    /// Mean extinction coefficient along the way at 633 nm [1/m].
    double MeanExtinction;
    /// Share of the light that is not hidden.
    double Visible;
  };

  /// Share of a group that is not hidden from a receiver; of a small one all or nothing.
  double Visible(const LightGroup& group, const Receiver& receiver) const;
  /// The ways to a light, where few may stand for all: the plate is no wider than a cell, or close
  /// and wide and they tell each other.
  std::optional<Ways> WaysTo(const LightGroup& root, const Vec3& point) const;
  /// Optical depth at 633 nm between the receiver and a place on the light.
  double Depth(const Receiver& receiver, const Vec3& place) const
  {
    return this->Depth(receiver, place, glm::length(place - receiver.Point));
  }
  /// @param distance between the two [m]
  double Depth(const Receiver& receiver, const Vec3& place, double distance) const;
  Path SamplePath(const LightGroup& group, const Receiver& receiver) const;
  /// By how much ways to places of a group differ in optical depth, of any band: as those known
  /// close to the plate do, else as they are longer or shorter in the thickest smoke.
  double ChangeOver(const LightGroup& group, const Receiver& receiver) const;
  void Gather(const LightGroup& group, const Receiver& receiver, const Path* path, int splits,
    Spectrum& sum) const;
  /// Optical depths of the ways from a point to a light's centre and to the corners of the
  /// rectangle around it, at 633 nm.
  struct Across
  {
    double Centre;
    std::array<double, 4> Corners;

    /// By how much they differ along the rectangle's first edge, and along its last one; twice.
    double Along() const
    {
      return std::abs(this->Corners[1] - this->Corners[0]) +
             std::abs(this->Corners[2] - this->Corners[3]);
    }
    double Up() const
    {
      return std::abs(this->Corners[3] - this->Corners[0]) +
             std::abs(this->Corners[2] - this->Corners[1]);
    }
  };
  static double BendFor(double tolerance);
  /// Whether a light is so far from a point that one way may stand for all.
  static bool Far(const LightGroup& root, const Vec3& point);
  /// Lets a receiver that lies before such a light know of the ways to it.
  void WalkFar(const LightGroup& root, Receiver& receiver) const;
  /// Ways to a far light of which one does not stand for all; none where it does, or where each
  /// place has its own.
  /// @param extinction mean along the way to its centre, if known [1/m]
  std::optional<Across> WaysAcross(
    std::size_t light, const Vec3& point, const std::optional<double>& extinction) const;
  /// Whether they change across the plate as a parabola does.
  bool Smooth(const Across& ways) const;
  /// Whether they differ from place to place as in smoke like noise: the few tell of all.
  bool Scattered(const Across& ways) const;
  /// A part of a light, and the optical depth of the way to its middle, at 633 nm.
  struct DimmedPart
  {
    Spectrum Share{};
    double Depth = 0.0;
  };
  /// The light's strips along the edge that ways differ along most, some of them together.
  /// @param line which of their two places to look at; none: their middles
  std::vector<DimmedPart> PartsAcross(
    std::size_t light, const Vec3& point, const Across& ways, const std::optional<int>& line) const;
  /// Mean over a light of what the smoke lets through, over what it lets through from its centre.
  Spectrum Unevenness(std::size_t light, const Vec3& point, const Across& ways) const;
  /// Corrects by it what the way to the centre of a light told.
  void DimUnevenly(std::size_t light, const Receiver& receiver, Spectrum& value) const;
  /// Adds what is above the horizon of a receiver of a leaf that it cuts, or nothing of one that is
  /// below; returns whether it is either.
  bool AddAboveHorizon(const LightGroup& leaf, const Receiver& receiver, const Path* path,
    int splits, Spectrum& sum) const;
  void AddPoint(
    const LightGroup& group, const Receiver& receiver, const Path& path, Spectrum& sum) const;
  /// Adds a group by its stencil, unless that does not serve this receiver: then it returns false.
  bool AddStencil(
    const LightGroup& group, const Receiver& receiver, const Path* path, Spectrum& sum) const;
  void AddLeaf(
    const LightGroup& leaf, const Receiver& receiver, const Path& path, Spectrum& sum) const;
  /// Fluence or illuminance at a receiver.
  Spectrum Fluence(std::size_t light, const Receiver& receiver) const;
  /// Mean fluence over a cell of a light that is near to it; none where it is not.
  std::optional<Spectrum> KeptFluence(std::size_t light, std::int64_t cell) const;
  /// Mean fluence over a part of a cell, of whatever light.
  Spectrum SampledFluence(std::size_t light, const CellPart& part) const;
  /// A light as a box in a smoke cell sees it.
  struct BoxLight
  {
    std::size_t Index;
    std::int64_t Cell;
    /// Around that from the centre of the box.
    Deepening Ways;
    /// One way stands for all ways from a place to the light.
    bool Far = false;
    /// A few percent of its fluence do not matter beside other lights'.
    bool Weak = false;
    /// Its fluence around it, if kept.
    const NearField* Near = nullptr;
  };
  /// Fluence at a point, as all below of what nothing hides.
  /// @param extinction mean along all ways to the light, if known [1/m]
  Spectrum Fluence(
    const BoxLight& light, const Vec3& point, const std::optional<double>& extinction) const;
  /// The ways from cells to a light.
  LightWays CellWays(std::size_t light) const;
  /// Mean fluence over the light's cell, no part of one.
  /// @param even whether smoke is known not to dim the light unevenly there
  Spectrum CellFluence(BoxLight light, bool even) const;
  /// The same over what finer grids leave of the cell.
  Spectrum OwnFluence(const BoxLight& light, int splits) const;
  /// What a light that were a point would send along a way from it, over its luminous intensity.
  static double PointLight(const LightGroup& light, const Vec3& way);
  /// Share of a light that is not hidden from a cell, in the mean over the light that the cell
  /// would get.
  /// @param ways to places of the light that tell it
  double ShownShare(std::size_t light, std::int64_t cell, std::uint64_t ways) const;
  /// What cells see of a light from right beside their centres.
  /// @param cells by their numbers
  std::vector<Sight> SightsFrom(
    const LightGroup& root, const CellsAround& around, std::span<const std::size_t> cells) const;
  /// What is known of a block and right around it, for one light.
  struct Known
  {
    const ClearBorders& Borders;
    LightWays Ways;
    const CellsAround& Around;
    /// What these cells see of the light: each is asked once.
    std::vector<std::optional<Sight>> Sights;
  };
  /// Share of a light that is not hidden from the cells of a block: of most of them their centres
  /// tell, others are crossed by the edge of a shadow. 0 of cells that walls cut, that the light is
  /// near to, or that lie behind it: they do not get it this way.
  /// @param roughly whether their centres do for all
  /// @param known of a block that this one is part of
  std::vector<double> ShownIn(
    std::size_t light, const Medium::Block& block, bool roughly, Known& known) const;
  /// What lies before a plate of a box that its plane cuts along two of the box's faces: none of
  /// its light gets behind it.
  static std::optional<Box> BeforePlate(const LightGroup& root, const Box& box);
  /// Mean over a box within the cell, which the plate's plane may cut.
  /// @param splits how often it may be split
  Spectrum LitBoxFluence(const BoxLight& light, const Box& box, int splits) const;
  /// The same of what lies before that plane.
  Spectrum BoxFluence(
    const BoxLight& light, const Vec3& centre, const Vec3& size, int splits) const;
  /// Mean extinction along all ways from a place in a box, where one stands for all [1/m].
  std::optional<double> ExtinctionFrom(
    const BoxLight& light, const Vec3& centre, const Vec3& place) const;
  /// Largest optical depth along an edge of a box, of any band.
  double BoxDepth(std::int64_t cell, const Vec3& size) const;
  /// By how much the way to a light deepens along an edge of a box, at most.
  double SteepestDepth(const BoxLight& light, const Vec3& size) const;
  /// Whether light comes to the box's cell from smoke of another density: ways to places in the box
  /// do not follow one another, then.
  bool BehindBorder(const BoxLight& light) const;
  /// A place in a box, for Gauss quadrature over it.
  struct GaussPlace;
  /// Adds so many places along each edge of a box (1 to 3), which has a share in a larger one.
  static void AddGaussPlaces(const Vec3& centre, const Vec3& size, const std::array<int, 3>& orders,
    double share, std::vector<GaussPlace>& places);
  /// The same in slabs along each axis, each half as thick as the one behind it.
  /// @param from way from the light to the centre
  static void AddSlabs(const Vec3& centre, const Vec3& size, const Vec3& from,
    const std::array<int, 3>& slabs, const std::array<int, 3>& orders,
    std::vector<GaussPlace>& places);
  /// Whether places in a box differ from its centre as they would before a point: that the light is
  /// no point matters as much at one of them as at another, then.
  /// @param places learn what a point would send to them
  bool Pointlike(const BoxLight& light, const Vec3& centre, const Vec3& size,
    std::vector<GaussPlace>& places) const;
  /// Mean over a box before such a light.
  /// @param extinction mean along some way between the box and the light [1/m]
  Spectrum PointlikeMean(const BoxLight& light, const Vec3& centre, double extinction,
    const std::vector<GaussPlace>& places) const;
  Spectrum GaussFluence(const BoxLight& light, const Vec3& centre, const Vec3& size) const;
  /// Whether a mean over the light's cell is right though smoke may dim the light unevenly: places
  /// in it have ways of their own, or what comes in through its faces counts.
  bool KnowsUneven(const BoxLight& light) const;
  /// Mean over the light's cell, corrected where smoke dims the light unevenly.
  /// @param fluence the mean by one way from each place to the light
  Spectrum UnevenFluence(const BoxLight& light, const Spectrum& fluence) const;
  /// Whether a box lies wholly behind a plate, and so gets nothing.
  static bool Behind(const LightGroup& root, const Vec3& centre, const Vec3& size);
  /// Of boxes that light hardly gets into.
  Spectrum GradedFluence(const BoxLight& light, const Vec3& centre, const Vec3& size) const;
  /// The ways from the cells of a block to a light.
  struct BlockWays
  {
    Medium::Block Cells;
    /// Mean extinction along each, x fastest; NaN: not known; none at all of a light that is not
    /// far [1/m].
    std::vector<double> Extinction{};
    /// Whether a few of them tell the rest, and how many cells' are told so.
    bool Tell = false;
    std::size_t Told = 0;
    /// Bound of what the light adds to any cell, over what that cell already holds, times the
    /// number of lights.
    double Share = std::numeric_limits<double>::infinity();
    /// Whether what is told may be off by more than differences from cell to cell would bear.
    bool Rough = false;
    /// Whether the corners tell of the others as well as ways across a far light are told.
    bool Smooth = false;
  };
  /// Whether smoke may dim a light unevenly in a block, as some of its cells tell where few ways
  /// tell of all.
  bool UnevenIn(std::size_t light, const Medium::Block& block, const BlockWays& told) const;
  /// Logarithms of what that makes of the light's mean in the cells at the corners of a block, of
  /// each band.
  using Corrections = std::array<std::array<double, 8>, MaxBands>;
  /// These, if they tell of the cells between them; none where they do not, or not all cells that
  /// are looked at are asked for.
  /// @param asked of each cell of the block, x fastest; none: not asked for
  std::optional<Corrections> TellUneven(
    const Medium::Block& block, const std::vector<std::optional<BoxLight>>& asked) const;
  /// That bound; infinite where there is none.
  /// @param asked the cells that count, of each cell of the block, x fastest
  /// @param extinction smallest mean along the ways from these [1/m]
  /// @param rough error of their optical depths
  double LargestShare(const Known& known, const Medium::Block& block,
    const std::vector<bool>& asked, double extinction, double rough,
    const std::vector<Spectrum>& sums) const;
  /// Whether light comes into any cell of a block from clear air at a slant so flat that the cell
  /// gets dark beside that face: its centre then tells nothing of what it gets.
  bool Enters(
    const LightGroup& root, const ClearBorders& borders, const Medium::Block& block) const;
  /// Whether a light is so far from the cells of a block that the ways to it are alike.
  bool FarFrom(const LightGroup& root, const Medium::Block& block) const;
  /// Lets the corners of such a block tell of its ways, if they do. The less a light may add to
  /// what the cells hold, the rougher its ways may be told.
  /// @param asked the cells that count, x fastest
  BlockWays TellWays(const Known& known, const Medium::Block& block, const std::vector<bool>& asked,
    const std::vector<Spectrum>& sums) const;
  /// Walks those that are asked for.
  BlockWays WalkWays(const Known& known, const Medium::Block& block, const std::vector<bool>& asked,
    const std::vector<Spectrum>& sums) const;
  /// Adds what is kept of the light in a block.
  void AddKept(std::size_t light, const Medium::Block& block, std::vector<Spectrum>& sums) const;
  /// Adds the light to the cells of a block that are asked for.
  /// @param shown share of it that is not hidden, of each cell
  BlockWork AddAsked(std::size_t light, const Known& known, const Medium::Block& block,
    const std::vector<bool>& asked, const std::vector<double>& shown, const BlockWays& ways,
    std::vector<Spectrum>& sums) const;
  /// Adds the light to a block within the one that this is known of.
  BlockWork AddBlockFluence(std::size_t light, Known& known, const Medium::Block& block, bool skips,
    std::vector<Spectrum>& sums) const;
  /// The same, to one eighth of the block after another.
  BlockWork AddPartsFluence(std::size_t light, Known& known, const Medium::Block& block, bool skips,
    std::vector<Spectrum>& sums) const;
  /// A triangle before a light.
  struct LitTriangle
  {
    std::size_t Light;
    Vec3 Centre, Normal;
    /// Whether smoke may dim the light unevenly there, once that was asked for.
    std::optional<bool> Uneven{};
    /// Illuminances of its front and back, as far as they are summed up.
    std::array<Spectrum, 2> Sum{};
  };
  /// Adds what a place on a part of it gets.
  void AddPlace(LitTriangle& whole, const Vec3& point, double weight, bool clear) const;
  /// Adds a part of it.
  /// @param level how often it was split from the whole
  void AddTriangle(LitTriangle& whole, const Triangle& corners, int level, double weight) const;

  const Scene& Scene_;
  LightSight Sight_;
  const NearLights* Near_;
  /// Optical depth by which ways across a far light may depart from a straight course.
  double Bend_;
  /// Optical depth of a box, of any band, above which it is measured at Gauss points.
  double Flat_;
};

} // namespace smokevis
