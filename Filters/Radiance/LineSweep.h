// One sweep of random global lines: light carried along straight lines through the whole scene.
#pragma once

#include "BatchState.h"
#include "CellSteps.h"
#include "DiffusionBlocks.h"
#include "GlobalLines.h"
#include "LightField.h"
#include "NoisyBoxes.h"
#include "PatchGroups.h"
#include "Scene.h"
#include "SourceShape.h"
#include "ThickCells.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace smokevis
{

class DirectField;
struct LineBuffers;

/// What a sweep adds up, by how much light differs from what was expected, times the weights of
/// the lines; one a thread.
struct LineTallies
{
  /// All that a line needs of a cell: it lies together, since lines meet cells far apart.
  struct alignas(32) Cell
  {
    /// Luminance of what the cell sends on and emits [cd/m2].
    float Source;
    /// Extinction coefficient [1/m], its sign set where the direct fluence varies inside the cell.
    float SignedExtinction;
    /// Radiance of both directions that is expected along a line, and the tally of what differs.
    float Expected, Fluence;
    /// Slopes of the luminance along the axes [cd/m3], and what it differs by at the smoke's lower
    /// corner, continued [cd/m2]; where it is steep (SourceShape), slopes of the logarithm of what
    /// varies [1/m], and that logarithm over the mean there.
    SourceShape::Slope Slope;
    float Offset;

    float Extinction() const { return std::abs(this->SignedExtinction); }
    bool DirectVaries() const { return std::signbit(this->SignedExtinction); }
  };
  std::vector<Cell> Cells;
  std::vector<float> Illuminance;
  std::vector<float> ExpectedIlluminance;
  /// Power that left the scene, not a difference [lm].
  double Escaped = 0.0;
  /// As in WatchedLight, of lines alone [lm].
  double WatchedLost = 0.0, WatchedGained = 0.0;
  /// As in BatchState.
  std::vector<MetLight> AtSides, AtCells;
};

/// What some of a sweep's lines bring to the noise of the light in cells.
struct LineSurvey
{
  /// What the square of a change of each cell's fluence counts [1/lx2].
  const std::vector<float>& Weights;
  /// One line in so many is surveyed.
  std::size_t Every;
  std::vector<SurveyedLine> Lines;
};

/// Draws lines of the uniform line measure, carries radiance along each in closed form through the
/// cells, and tallies its path integral in every cell crossed and its arriving radiance on every
/// surface met. A surface starts the line anew with its own outgoing radiance. Each line serves
/// both of its directions. (Random-ray method, Tramm et al. 2017; global-line radiosity, Sbert
/// 1997.)
class LineSweep
{
public:
  /// @param field holds the direct light of all cells and patches
  /// @param direct the same fluence inside the cells; must outlive the sweep
  /// @param tolerance that is asked for; a large one needs fewer lines
  /// @param progress tells when to stop: the sweep is of no use then
  LineSweep(const Scene& scene, const LightField& field, const DirectField& direct, int band,
    double tolerance, const Progress& progress);

  /// Lines that cross a cell of its mesh's mean size about 1.5 times, or less often where little is
  /// asked for.
  std::size_t Lines() const { return this->Lines_.Count(); }
  /// How many of them are expected to meet a side of a patch, or the group that it shares light
  /// with.
  float SideHits(std::size_t side) const { return this->SideHits_[side]; }
  /// The box that they enter and leave the scene through.
  const Box& Outer() const { return this->Lines_.Outer(); }
  /// Those of a whole sweep.
  const GlobalLines& AllLines() const { return this->Lines_; }
  /// Lets the sources vary inside the cells as the means of the batches' sums do.
  void Follow(const std::vector<BatchState>& batches) { this->Shape_.Follow(batches); }

  /// Tallies from now on what light watched places send to each other.
  void Watch(WatchedPlaces places) { this->Watched_ = std::move(places); }
  bool Watches() const { return !this->Watched_.Sides.empty(); }
  const WatchedPlaces& Watched() const { return this->Watched_; }
  /// Power of a state's latest light that meets the watched places, and what of it they take up at
  /// once [lm].
  struct Holding
  {
    double Power = 0.0, TakenUp = 0.0;
  };
  Holding HeldByWatched(const BatchState& state) const;

  const PatchGroups& Groups() const { return this->Groups_; }
  const ThickCells& Thick() const { return this->Thick_; }
  /// Blocks that complete what whole sweeps find; none where little is scattered often.
  const std::optional<DiffusionBlocks>& Blocks() const { return this->Blocks_; }
  /// Does without them from now on.
  void LeaveOutBlocks() { this->Blocks_.reset(); }
  /// Share of what a whole sweep would change of the light that it does change (CellSteps).
  double MeanStep() const { return this->Steps_.MeanStep(); }
  /// Lines of a sweep, and what share of a whole one it is.
  struct Choice
  {
    GlobalLines Lines;
    float Share;
  };
  Choice Whole() const { return {this->Lines_, 1.0F}; }
  /// A share of those without any added ones, but no fewer than surfaces need to send on what the
  /// sweep finds.
  Choice Thin(double share) const;
  /// Whether some were added.
  bool HasMoreLines() const { return this->Lines() > this->PlainLines_.Count(); }

  /// One sweep with fresh lines. The new estimate replaces state.Fluence and state.Illuminance, or
  /// takes them some way where its noise would grow, and is added to the sums.
  /// @param key of the random numbers; must differ from sweep to sweep and batch to batch
  /// @param choice of lines
  /// @param tallies scratch
  /// @param survey what some of the lines bring, if that is asked for
  void Run(BatchState& state, LineTallies& tallies, std::uint64_t key, const Choice& choice,
    const Progress& progress, LineSurvey* survey = nullptr) const;
  /// Draws more lines from now on, which whole sweeps have beside those that they had: half of them
  /// through the box, half from places in it to places anywhere in the smoke, where noise counts.
  void AddLines(const NoisyBox& box)
  {
    const std::size_t half = GlobalLines::AtLeast(0.5 * box.Lines);
    const Medium& smoke = this->Scene_.Smoke();
    this->Lines_.AddInner(box.Bounds, half);
    this->Lines_.AddJoining(box.Bounds, {smoke.Lower(), smoke.Upper()}, half);
  }

private:
  /// Gives the sources of the cells their shapes.
  void ShapeSources(const BatchState& state, LineTallies& tallies) const;
  /// Empties the tallies, and expects the light that is known so far of the cells and patches where
  /// that tells something.
  void Prepare(const BatchState& state, LineTallies& tallies) const;
  void TraceLine(const BatchState& state, const GlobalLines::Line& line, LineTallies& tallies,
    LineBuffers& buffers) const;
  /// Share of a whole sweep's lines that surfaces need to send on all of what a sweep found, in the
  /// mean.
  double HitsShare() const;
  /// Lines that must meet a side in a sweep for it to send on all of what that sweep found.
  float HitsForWholeStep(std::size_t side) const;
  /// Sum of the squares that a line which was just traced brings to cells, times what these count.
  float SquareOf(const GlobalLines::Line& line, const LineTallies& tallies,
    const LineBuffers& buffers, const std::vector<float>& weights) const;
  /// Tallies what light the line takes from watched places, and to them.
  void TallyWatched(
    const BatchState& state, double weight, const LineBuffers& buffers, LineTallies& tallies) const;
  /// Radiance that a watched side sends on of what others sent to it; 0 from all other sides.
  float WatchedOutgoing(const BatchState& state, const Hit& hit) const;
  /// Takes the tallies of the cells into a state.
  /// @param share of a whole sweep's lines that were traced
  void TakeFluence(const LineTallies& tallies, float share, BatchState& state) const;
  /// Part of a steep cell's source that is even along each piece of a line: what the cell emits,
  /// and direct light where it is known inside the cell.
  float EvenSource(std::int64_t cell, bool directVaries) const;
  /// Radiance that leaves a side of a patch along a line.
  float Outgoing(const BatchState& state, const Hit& hit, const Vec3& direction) const;

  const Scene& Scene_;
  const DirectField& Direct_;
  const float* DirectFluence_;
  const float* DirectIlluminance_;
  int Band_;
  /// Scattered source luminance over fluence: albedo / (4 pi) where there is smoke.
  float Scatter_;
  /// 1 / volume of each cell.
  std::vector<float> InverseVolume_;
  /// As in LineTallies::Cell.
  std::vector<float> SignedExtinction_;
  /// Luminance of emission alone, (1 - albedo) L_emit; empty: none.
  std::vector<float> Emission_;
  /// Of a whole sweep, and these without any added ones.
  GlobalLines Lines_, PlainLines_;
  /// Share of the latter that a thin sweep has at least.
  double FewestShare_ = 1.0;
  /// Whether lines fetch what they need to know of how direct light varies inside cells.
  bool FetchesDirect_ = false;
  ThickCells Thick_;
  SourceShape Shape_;
  CellSteps Steps_;
  std::optional<DiffusionBlocks> Blocks_;
  /// How often lines of one sweep are expected to meet each cell and each side of a patch.
  std::vector<float> CellCrossings_, SideHits_;
  PatchGroups Groups_;
  WatchedPlaces Watched_;
};

} // namespace smokevis
