// One exit sign as its maker describes it, and how its plate is cut into lit and unlit cells.
#pragma once

#include "PlateMesh.h"

#include <string>

namespace smokevis
{

enum class SignPattern
{
  /// One lit square in the middle of the plate.
  Square = 0,
  /// Upright bars, the first, third, ... lit.
  Barcode = 1,
  /// The grey levels of an image file.
  Image = 2
};

struct SignPlate
{
  /// Where the sign is described, for error messages; may be empty.
  std::string Origin;
  int Id = 0;
  std::string Name;
  Vec3 Centre{0.0};
  Vec3 Normal{1.0, 0.0, 0.0};
  Vec3 Up{0.0, 0.0, 1.0};
  /// [m]
  double Width = 0.6;
  double Height = 0.3;
  SignPattern Pattern = SignPattern::Barcode;
  int Bars = 9;
  /// Side of the lit square over the plate's shorter side.
  double SquareFraction = 0.5;
  std::string PatternFile;
  /// Photometric luminance of lit and unlit parts [cd/m2].
  double Luminance = 300.0;
  double UnlitLuminance = 0.0;
  double Colour[3] = {1.0, 1.0, 1.0};
  double Reflectance = 0.0;
};

/// The grey levels of an image file, 0 to 1, bottom row first.
struct Stencil
{
  int Width = 0;
  int Height = 0;
  std::vector<double> Grey;

  /// Reads a PNG file. Throws Error where the file is missing, not an
  /// image, damaged, or has more than MaximumPixels.
  static Stencil Read(const std::string& fileName);

  static constexpr std::int64_t MaximumPixels = 250000;
};

/// Cuts the sign's plate and adds it to the mesh. Throws Error for values out of range.
void AddSign(const SignPlate& sign, PlateMesh& mesh);

/// Reads a table of signs, a sign a row; what a row does not say comes from `defaults`. The header
/// line names the columns, in any order: cx, cy, cz (needed), id, name, nx, ny, nz, ux, uy, uz,
/// width, height, pattern (Square, Barcode, Image), bars, luminance. Blank lines and lines that
/// begin with # are left out. Throws Error with the number of the line at fault.
std::vector<SignPlate> ReadSignTable(const std::string& fileName, const SignPlate& defaults);

} // namespace smokevis
