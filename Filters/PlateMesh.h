// The polydata that sign and lamp sources put out: plane plates cut into quads.
#pragma once

#include "Types.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

class vtkPolyData;

namespace smokevis
{

/// Where a plate is and which way it looks. Right x Up = Normal; right and up as seen from the
/// front.
struct PlateFrame
{
  Vec3 Centre;
  Vec3 Right;
  Vec3 Up;
  Vec3 Normal;

  /// Throws Error for a normal or up vector of no length. Where up is parallel to the normal (a
  /// plate that lies flat), y, or else x, takes its place.
  /// @param name  the plate, for the error message
  static PlateFrame Make(
    const Vec3& centre, const Vec3& normal, const Vec3& up, const std::string& name);
};

/// Collects plates and turns them into polydata with the cell arrays Luminance, SignId, Reflectance
/// and, where a plate has a name, SignName.
class PlateMesh
{
public:
  /// What the cells of a plate share.
  struct Plate
  {
    PlateFrame Frame;
    int SignId = -1;
    std::string Name;
    double Reflectance = 0.0;
  };

  /// Cuts a plate along the lines u (along Right) and v (along Up), ascending, in metres from the
  /// plate's centre. Cells share their corners, so that they neither overlap nor leave a gap.
  /// Strips without width are left out.
  void Add(const Plate& plate, const std::vector<double>& u, const std::vector<double>& v,
    const std::function<Spectrum(std::size_t, std::size_t)>& luminance);

  /// The polydata of all plates.
  vtkSmartPointer<vtkPolyData> Finish() const;

private:
  struct Cell
  {
    std::array<std::int64_t, 4> Corners;
    Spectrum Luminance;
    std::size_t Plate;
  };

  std::vector<Vec3> Points_;
  std::vector<Cell> Cells_;
  std::vector<Plate> Plates_;
};

/// Band luminances of a linear RGB colour, scaled to a photometric luminance. Throws Error where
/// the colour is black or has a component outside [0, 1].
Spectrum ColouredLuminance(double luminance, const double colour[3], const std::string& name);

} // namespace smokevis
