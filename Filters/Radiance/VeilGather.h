// The veil of multiply scattered light along one line of sight, gathered along rays.
#pragma once

#include "IndirectLight.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

/// A veil and what it took.
struct GatheredVeil
{
  /// Batches of the veil [cd/m2].
  Lanes Multiple;
  /// Rays of all batches.
  std::size_t Rays = 0;
};

/// In the dark, few random lines bring light to the cells that an eye looks through, so that the
/// light field knows their light badly. Rays from places along the line of sight tell it better:
/// what each brings is the mean over all cells that it passes. A batch has rays of its own through
/// its own light, so that the batches stay independent.
class VeilGather
{
public:
  /// @param field is what indirect has the light of, in a band
  /// @param end of the line of sight [m]
  VeilGather(const Scene& scene, const LightField& field, const IndirectLight& indirect, int band,
    const Vec3& origin, const Vec3& direction, double end);

  /// Gathers until the standard error is as small as wanted [cd/m2] or most rays are drawn.
  GatheredVeil Run(double wanted) const;

private:
  /// A piece of the line inside one cell.
  struct Piece
  {
    double Begin = 0.0;
    double Length = 0.0;
    double Extinction = 0.0;
    /// Luminance at the eye over fluence.
    double Weight = 0.0;
    /// Share of the rays that begin here.
    double Share = 0.0;
    /// Sum of the shares up to this piece's end.
    double Until = 0.0;
  };

  /// What one ray adds to the mean of a batch.
  double Sample(int batch, const std::array<double, 4>& random) const;

  const IndirectLight& Indirect_;
  Vec3 Origin_, Direction_;
  std::vector<Piece> Pieces_;
  /// Of the line and of the field, so that rays of different ones are independent.
  std::uint64_t Key_ = 0;
};

} // namespace smokevis
