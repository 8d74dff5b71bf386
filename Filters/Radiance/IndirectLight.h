// Light along rays through a solved light field, but for what lights send directly.
#pragma once

#include "CellShape.h"
#include "DirectLight.h"
#include "LightField.h"
#include "Scene.h"

namespace smokevis
{

class DirectField;

/// What comes in along rays that are gathered somewhere: light of the second and later order, and
/// of the sky and of smoke that glows.
class IndirectLight
{
public:
  /// How surfaces send on what lights send to them.
  enum class Reflection
  {
    /// By what their patches get in the mean.
    OfPatches,
    /// Close to where rays begin, and to a light, by what there is where a ray ends.
    OfPlaces
  };
  /// @param field holds all light of the band
  /// @param direct is the direct light in the smoke
  /// @param shape is that of the rest; all must outlive this
  IndirectLight(const Scene& scene, const LightField& field, const DirectField& direct,
    const CellShape& shape, int band, Reflection reflection);

  const Scene& TheScene() const { return this->Scene_; }
  const LightField& Field() const { return this->Field_; }
  int Band() const { return this->Band_; }

  /// Radiance against a ray in one batch [cd/m2].
  /// @param place where near lights are taken (DirectField::ForEachPart), 0 to 1
  double Radiance(const Vec3& origin, const Vec3& direction, double place, int batch) const;

private:
  double Leaving(const Hit& hit, const Vec3& point, const Vec3& direction, int batch) const;
  /// Direct illuminance where a ray ends on a patch [lx].
  double DirectOn(std::size_t patch, const Hit& hit, const Vec3& point) const;

  const Scene& Scene_;
  const LightField& Field_;
  const DirectField& Direct_;
  const CellShape& Shape_;
  DirectLight Lights_;
  int Band_;
  Reflection Reflection_;
};

} // namespace smokevis
