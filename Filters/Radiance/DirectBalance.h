// Holds the direct light of each light to the conservation of power where none of it can leave the
// scene.
#pragma once

#include "LightField.h"
#include "Types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smokevis
{

class NearLights;
class Scene;
class Team;

/// In a closed room smoke and surfaces take up what a light sends out. Means over cells and patches
/// come from a few points of each and are off in smoke that differs from cell to cell like noise,
/// and at the edges of shadows: by up to 1 % of the power in all, 2 % of what comes from afar. Each
/// light by itself is scaled to make up for that, so that the light of several still adds up; but
/// not where it is known from close to the light, and by the less the more of it is so by a few
/// places in each cell.
class DirectBalance
{
public:
  /// @param blocks of cells, and parts of cells, by whose numbers light is added
  DirectBalance(const Scene& scene, const LightField& field, std::size_t blocks, std::size_t parts);

  /// Whether a light may be scaled: it has no measured table, none of it leaves the scene, as rays
  /// from it tell (an opening through which less than about a thousandth leaves may be missed), and
  /// what all lights add everywhere fits into memory.
  bool Watches(std::size_t light) const { return !this->Watched_[light].Cells.empty(); }

  // What is added of a light that is watched. Items of different numbers may be added to at once.

  /// @param fluence mean over the cell [lx]
  void AddToCell(std::size_t block, std::size_t light, std::int64_t cell, const Spectrum& fluence);
  void AddToPart(std::size_t part, std::size_t light, std::int64_t cell, const Spectrum& fluence);
  void AddToPatch(std::size_t patch, int side, std::size_t light, const Spectrum& illuminance);

  /// Adds what the lights lack to the sums over all of them, of cells and of both sides of patches.
  /// Returns what was done.
  std::vector<WorkItem> MakeUp(
    Team& team, std::vector<Spectrum>& cells, std::vector<std::array<Spectrum, 2>>& patches);

private:
  /// What may be scaled of a light, in each band; no cells: nothing is.
  struct Watched
  {
    std::vector<float> Cells, Sides;
  };
  /// Power that is taken up of a light in an item [lm]: as the light itself tells, as places close
  /// to it do, and what is scaled.
  struct Power
  {
    Spectrum Exact{}, Known{}, Scaled{};
  };

  bool Closed(std::size_t light) const;
  Power& PowerOf(std::size_t item, std::size_t light)
  {
    return this->Powers_[item * this->Watched_.size() + light];
  }
  /// Power that a cell takes up.
  Spectrum TakenIn(std::int64_t cell, const Spectrum& fluence) const;
  void Complete(Team& team);

  const Scene& Scene_;
  const NearLights& Near_;
  std::size_t Cells_, Blocks_, Parts_, Patches_;
  std::vector<Watched> Watched_;
  /// Of the blocks, the parts and the patches, of all lights each.
  std::vector<Power> Powers_;
};

} // namespace smokevis
