// The fluence around one light, kept on nested lattices so that many views may share it.
#pragma once

#include "DirectLight.h"

#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace smokevis
{

struct LightGroup;

/// Boxes around a light's plate, each twice as far from it as the one inside. Their nodes hold the
/// light's fluence over that of an evenly bright plate in even smoke, a closed form: what is left
/// varies slowly and is interpolated. A node is computed when it is first asked for; its value
/// depends on the scene alone, so that it does not matter which thread does so. There are boxes as
/// far as a lattice's step is no thicker than a few mean free paths: beyond, light is asked for
/// itself.
class NearField
{
public:
  /// @param reach distance from the plate up to which fluences will be asked for [m]
  /// @param longestStep of a lattice, but of the innermost: what it may be for the smoke's sake [m]
  /// @param coarse whether it will do to know fluences to two percent, rather than one
  NearField(const Scene& scene, const DirectLight& direct, std::size_t light, double reach,
    double longestStep = std::numeric_limits<double>::infinity(), bool coarse = false);
  ~NearField();

  /// Fluence at a point that sees the whole light [lx].
  double Fluence(const Vec3& point, int band) const;

  /// Whether a point lies farther from the plate than the innermost box, where the fluence follows
  /// the plate's pattern, or the smoke right at the plate, more closely than the lattice does.
  bool Smooth(const Vec3& point) const;

  /// Length over which the light changes right before the plate [m]: infinite for a single leaf.
  double PatternLength() const { return this->PatternLength_; }

private:
  struct Level;

  /// Computes the light's fluence at a node that nobody asked for before over the closed form's, or
  /// its logarithm, in all bands; that is -infinity where it is 0. Returns that of a band.
  float FillNode(const Level& level, const std::array<int, 3>& node, int band) const;
  /// The same at a place, by the quadratic through the nodes around it; not finite where it is 0 at
  /// one of them.
  double Quadratic(const Level& level, const Vec3& place, int band) const;
  /// The light's fluence at a place over that of the plate without smoke, by linear interpolation.
  double Linear(const Level& level, const Vec3& place, int band) const;
  /// Place relative to the plate's centre: along its edges and along its normal.
  Vec3 ToPlate(const Vec3& point) const;
  Vec3 FromPlate(const Vec3& place) const;
  /// How far a place before the plate is from the plate, as boxes are [m].
  double Away(const Vec3& place) const;
  /// Solid angle of the plate's rectangle, or of a single leaf.
  double PlateAngle(const Vec3& point) const;
  /// Optical depth of even smoke between a place and the plate [-].
  double EvenDepth(const Vec3& place, int band) const;

  const Scene& Scene_;
  const DirectLight& Direct_;
  std::size_t Light_;
  Vec3 Centre_{0.0};
  std::array<Vec3, 3> Axes_;
  /// Half the plate's edges.
  std::array<double, 2> Half_{};
  double PatternLength_ = std::numeric_limits<double>::infinity();
  /// Extinction at the plate, at 633 nm [1/m].
  double Extinction_ = 0.0;
  std::vector<std::unique_ptr<Level>> Levels_;
};

} // namespace smokevis
