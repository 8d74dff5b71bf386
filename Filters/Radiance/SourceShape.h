// How what smoke sends on varies inside its cells, as random lines carry it.
#pragma once

#include "Types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smokevis
{

class DirectField;
class Medium;
class OpenFaces;
class Scene;
struct BatchState;
struct LightField;

/// Light falls off inside a cell by the more the thicker its smoke. A source that is flat in each
/// cell lets too much of it through: a fifth too much through five cells of a mean free path. Here
/// it is linear along each axis, as the mean of all batches falls off between the neighbours; its
/// mean over the cell stays what it is.
class SourceShape
{
public:
  /// Optical depth across a cell above which its source is flat: it would need millions of sweeps
  /// to settle.
  static constexpr double ThickestDepth = 4.0;

  SourceShape() = default;
  /// @param field holds the direct light of all cells, direct that inside the cells; both must
  /// outlive this
  /// @param extinction of each cell in the band [1/m]
  SourceShape(const Scene& scene, const LightField& field, const DirectField& direct, int band,
    const std::vector<float>& extinction);

  /// Takes the shapes from the means of the batches' sums.
  void Follow(const std::vector<BatchState>& batches);

  /// Whether no cell is thick enough for its shape to matter.
  bool Flat() const { return this->Cells_.empty(); }
  /// Change of a cell's source along each axis over its mean, or of its logarithm where it is steep
  /// [1/m].
  using Slope = std::array<float, 3>;
  /// A cell whose source has a shape.
  struct Shaped
  {
    std::int64_t Index = 0;
    /// Its centre, from the smoke's lower corner [m].
    Vec3 Place{0.0};
    /// Whether direct light is known inside the cell: the shape is that of the rest.
    bool DirectVaries = false;
    Slope Change{};
    /// Logarithm of a steep source over its mean, in the middle of the cell.
    float Middle = 0.0F;
  };
  const std::vector<Shaped>& Cells() const { return this->Cells_; }
  /// Whether a cell's source is exponential.
  bool Steep(std::int64_t cell) const { return !this->Steep_.empty() && this->Steep_[cell] != 0; }
  /// What a source adds that rises along a piece of a ray by 1 and is 0 in its middle, at the
  /// piece's end; at its beginning, looking along the ray, as much is missing.
  /// @param depth of the piece
  /// @param escape (1 - exp(-depth)) / depth
  static float Tilt(float depth, float escape)
  {
    return depth < 0.1F ? depth * depth * (1.0F / 12.0F - depth * (1.0F / 24.0F))
                        : 1.0F - escape * (1.0F + 0.5F * depth);
  }

private:
  /// What the slopes of a cell are told by.
  struct Measures
  {
    /// Along each axis, of the rises between Beside() on the low side, the cell, and Beside() on
    /// the high side (SlopeWeights) [1/m].
    std::array<std::array<float, 2>, 3> Factors;
    /// Half the cell's edges [m].
    std::array<float, 3> Half;
    /// Whether its source may be steep.
    bool MayBeSteep;
    /// Of its fluence what is even in it (OwnGlow) [lx].
    float Glow;
  };

  /// The neighbour that tells a slope, or the cell itself where there is none: the middle of what
  /// finer grids leave of a cell is somewhere else than its own.
  std::int64_t Beside(std::int64_t cell, int axis, int side) const;

  const Medium* Smoke_ = nullptr;
  const OpenFaces* Open_ = nullptr;
  const float* DirectFluence_ = nullptr;
  /// Of the extinction coefficient in the band.
  double Scale_ = 1.0;
  /// By how much the logarithm of light falls over a mean free path, deep in smoke.
  double Decay_ = 1.0;
  std::vector<Shaped> Cells_;
  std::vector<Measures> Measures_;
  /// Empty where no cell's source is.
  std::vector<char> Steep_;
};

} // namespace smokevis
