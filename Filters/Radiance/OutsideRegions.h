// Where light goes that leaves all smoke cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace smokevis
{

class Scene;

/// What lies outside of all smoke cells, in regions that light passes through freely: from faces
/// where the smoke ends and no surface is to the surfaces seen from there, to those seen from
/// these, and to other such faces. What joins on through a narrow way, as through a door, is a
/// region of its own. What light does not come to, such as what lies behind the walls of a room, is
/// none.
class OutsideRegions
{
public:
  /// Follows rays.
  explicit OutsideRegions(const Scene& scene);

  struct Face
  {
    std::int64_t Cell;
    /// 0..2, and 0: low, 1: high.
    int Axis, Side;
    /// [m2].
    double Area;
  };
  const std::vector<Face>& Faces() const { return this->Faces_; }
  std::size_t Count() const { return this->EscapingShare_.size(); }
  /// Region that a face leads to.
  std::int32_t OfFace(std::size_t face) const { return this->OfFace_[face]; }
  /// Region that a side of a patch, 2 * patch + side, bounds where no smoke is; -1: none.
  std::int32_t OfSide(std::size_t side) const { return this->OfSide_[side]; }
  /// Area of all that bounds a region [m2].
  double BoundingArea(std::size_t region) const { return this->BoundingArea_[region]; }
  /// Areas of the ways between regions [m2].
  const std::map<std::pair<std::int32_t, std::int32_t>, double>& Passages() const
  {
    return this->Passages_;
  }
  /// Share of the light that comes from all that bounds a region which leaves the scene.
  double EscapingShare(std::size_t region) const { return this->EscapingShare_[region]; }

private:
  std::vector<Face> Faces_;
  std::vector<std::int32_t> OfFace_, OfSide_;
  std::vector<double> BoundingArea_, EscapingShare_;
  std::map<std::pair<std::int32_t, std::int32_t>, double> Passages_;
};

} // namespace smokevis
