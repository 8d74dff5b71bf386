// The veil of multiply scattered light before an eye, gathered along rays.
#pragma once

#include "IndirectLight.h"

#include <cstdint>
#include <vector>

namespace smokevis
{

/// A line of sight from the eye.
struct SightLine
{
  /// Unit direction.
  Vec3 Direction;
  /// Length [m].
  double End = 0.0;
  /// Share in the mean over several lines.
  double Weight = 1.0;
};

/// A veil and what it took.
struct GatheredVeil
{
  /// Batches of the veil [cd/m2].
  Lanes Multiple;
  /// Rays of all batches; none where no smoke scatters.
  std::size_t Rays = 0;
};

/// In the dark, few random lines bring light to the cells that an eye looks through, so that the
/// light field knows their light badly. Rays from places along the lines of sight tell it better:
/// what each brings is a mean over all cells that it passes. A batch has rays of its own through
/// its own light, so that the batches stay independent but for the shapes inside cells. There are
/// always as many rays: those that happen to agree are not the best ones.
class VeilGather
{
public:
  /// @param field is what indirect has the light of, in a band
  VeilGather(const Scene& scene, const LightField& field, const IndirectLight& indirect, int band,
    const Vec3& origin, const std::vector<SightLine>& lines);

  GatheredVeil Run() const;

private:
  /// A piece of a line inside one cell.
  struct Piece
  {
    Vec3 Direction;
    double Begin = 0.0;
    double Length = 0.0;
    double Extinction = 0.0;
    /// Share of the light from behind that is lost.
    double Lost = 0.0;
    /// Mean luminance at the eye over fluence.
    double Weight = 0.0;
    /// Share of the rays that begin here.
    double Share = 0.0;
    /// Sum of the shares up to this piece's end.
    double Until = 0.0;
  };

  /// What one ray adds to the mean of a batch.
  double Sample(int batch, const std::array<double, 4>& random) const;

  const IndirectLight& Indirect_;
  Vec3 Origin_;
  std::vector<Piece> Pieces_;
  /// Of the lines and of the field, so that rays of different ones are independent.
  std::uint64_t Key_ = 0;
};

} // namespace smokevis
