// The polydata that sign and lamp sources put out: plane plates cut into quads.
#pragma once

#include "Types.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

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

/// How one cell of a plate looks.
struct CellLook
{
  Spectrum Luminance{};
  Spectrum Reflectance{};
  /// Of a sign: whether it belongs to the parts that are to be bright.
  bool Lit = true;
};

/// Collects plates and turns them into polydata with the cell arrays Luminance, SignId, Reflectance
/// and, where a plate is a sign, SignName and SignPart (1: lit, 0: unlit); EmissionExponent where
/// one is not 0.
class PlateMesh
{
public:
  /// What the cells of a plate share.
  struct Plate
  {
    PlateFrame Frame;
    int SignId = -1;
    std::string Name;
    double Exponent = 0.0;
  };

  /// Cuts a plate along the lines u (along Right) and v (along Up), ascending, in metres from the
  /// plate's centre. Cells share their corners, so that they neither overlap nor leave a gap.
  /// Strips without width are left out.
  void Add(const Plate& plate, const std::vector<double>& u, const std::vector<double>& v,
    const std::function<CellLook(std::size_t, std::size_t)>& look);

  /// Adds convex cells, counter-clockwise, by their corners in metres from the plate's centre.
  struct PlateCell
  {
    std::vector<glm::dvec2> Corners;
    CellLook Look;
  };
  void Add(const Plate& plate, const std::vector<PlateCell>& cells);

  /// The polydata of all plates.
  vtkSmartPointer<vtkPolyData> Finish() const;

private:
  struct Cell
  {
    std::vector<vtkIdType> Corners;
    CellLook Look;
    std::size_t Plate;
  };

  std::vector<Vec3> Points_;
  std::vector<Cell> Cells_;
  std::vector<Plate> Plates_;
};

/// Band luminances of a linear RGB colour, scaled to a photometric luminance. Throws Error where
/// the colour is black or has a component outside [0, 1].
Spectrum ColouredLuminance(double luminance, const double colour[3], const std::string& name);
/// The same for a reflectance, of which no band may be above 1.
Spectrum ColouredReflectance(double reflectance, const double colour[3], const std::string& name);

} // namespace smokevis
