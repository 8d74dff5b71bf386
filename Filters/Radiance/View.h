// Radiance along rays through a scene whose light field is known.
#pragma once

#include "LightField.h"
#include "Scene.h"

#include <memory>
#include <vector>

namespace smokevis
{

struct GatheredVeil;
struct SightLine;

/// What arrives along one ray, in one band.
struct RayLight
{
  /// Luminance of the surface that ends the ray, as it arrives (after transmittance) [cd/m2].
  double Surface = 0.0;
  /// Batches of the part of Surface that is reflected light of the second and later order.
  Lanes SurfaceMultiple;
  /// Light scattered or emitted by smoke on the way [cd/m2], without its batches' share.
  double VeilDirect = 0.0;
  /// Batches of the veil of multiply scattered light [cd/m2].
  Lanes VeilMultiple;
  /// Optical depth to the end of the ray.
  double OpticalDepth = 0.0;

  /// Veil in all [cd/m2].
  double Veil() const;
  /// Luminance in all [cd/m2].
  double Total() const;
  /// Luminance in all, a value a batch [cd/m2].
  Lanes TotalLanes() const;
};

/// What views leave out; off: to measure what that saves.
struct ViewSkips
{
  /// The rest of a ray where so much smoke lies before it that it adds next to nothing.
  bool HiddenSmoke = true;
  /// Looks at the parts of a sign where nothing reaches between that and the eye.
  bool Looks = true;
  /// All that there is to do for a sign that surfaces hide as a whole.
  bool HiddenSigns = true;
};

/// A light field and what views of it need. Immutable but for a count; Trace may be called from
/// many threads.
class View
{
public:
  View(std::shared_ptr<const Scene> scene, std::shared_ptr<const LightField> field,
    const ViewSkips& skips = {});
  ~View();

  const Scene& TheScene() const { return *this->Scene_; }
  const LightField& Field() const { return *this->Field_; }
  const ViewSkips& Skips() const { return this->Skips_; }

  /// First shape that a ray meets, at most `end` metres away.
  Hit FirstHit(const Vec3& origin, const Vec3& direction,
    double end = std::numeric_limits<double>::infinity()) const;

  /// Light that arrives at the origin against the direction of the ray, which ends at `hit` or,
  /// where nothing was hit, at the sky. Where the hit is an emitter cell its own luminance is
  /// included.
  RayLight Trace(const Vec3& origin, const Vec3& direction, const Hit& hit, int band) const;

  /// Only the share of that light that the smoke between two distances sends (Surface stays 0). The
  /// optical depth is that of the ray from its origin to `end`.
  /// @param ahead veil of the smoke up to `begin` [cd/m2]: what adds next to nothing to it counts
  /// as nothing
  RayLight TraceVeil(const Vec3& origin, const Vec3& direction, double begin, double end, int band,
    double ahead = 0.0) const;

  /// Rays so far, of each band, of which a part was left out, since it adds next to nothing.
  std::size_t RaysCutShort() const;
  /// Bound of the luminance that smoke sends out in any direction, were it infinitely thick
  /// [cd/m2].
  double BrightestSmoke(int band) const;

  /// Mean over lines of sight from one origin of RayLight::VeilMultiple, gathered anew: for where
  /// the field knows it too badly.
  GatheredVeil GatherVeil(const Vec3& origin, const std::vector<SightLine>& lines, int band) const;

  /// Luminance that leaves an emitter cell towards a direction (unit, away from the plate), emitted
  /// and reflected [cd/m2], before any smoke.
  /// @param lanes receives the batches of what is reflected of multiply scattered light
  double EmitterLuminance(std::size_t emitter, int side, const Vec3& point, const Vec3& towards,
    int band, Lanes& lanes) const;

  /// Illuminance at a point of a surface with a unit normal, straight from lights [lx].
  Spectrum DirectIlluminance(const Vec3& point, const Vec3& normal) const;
  /// Batches of the multiply scattered illuminance at a point of a side of a patch [lx].
  Lanes MultipleIlluminance(std::size_t patch, int side, const Vec3& point, int band) const;
  /// Illuminance at a point of a side of a patch [lx].
  /// @param lanes receives the batches of what is multiply scattered of it
  double Illuminance(std::size_t patch, int side, const Vec3& point, const Vec3& normal, int band,
    Lanes& lanes) const;

  /// Whether a point lies inside a solid: closed in by backs of surfaces (and plates) on all sides,
  /// without smoke and without light.
  bool InsideSolid(const Vec3& point) const;

private:
  struct Implementation;

  /// Luminance that a side of a patch reflects at a point, and its batches of multiply scattered
  /// light.
  double Reflected(std::size_t patch, int side, const Vec3& point, const Vec3& normal, int band,
    Lanes& lanes) const;

  std::shared_ptr<const Scene> Scene_;
  std::shared_ptr<const LightField> Field_;
  ViewSkips Skips_;
  std::unique_ptr<Implementation> Implementation_;
};

} // namespace smokevis
