// One exit sign as its maker describes it, and how its plate is cut into lit and unlit cells.
#pragma once

#include "PlateMesh.h"

#include <string>

namespace smokevis
{

enum class SignPattern
{
  /// One square in the middle of the plate.
  Square = 0,
  /// Upright bars, the first, third, ... belong to the figure.
  Barcode = 1,
  /// The grey levels of an image file.
  Image = 2,
  /// Block letters.
  Text = 3,
  /// A man who runs through a door.
  RunningMan = 4
};

enum class SignDesign
{
  /// A bright figure on a dark ground.
  Stencil = 0,
  /// A dark figure on a bright ground.
  Panel = 1
};

/// Looks that standards ask for.
enum class SignPreset
{
  /// As the properties say.
  Custom = 0,
  En1838 = 1,
  En1838Smoke = 2,
  Iso3864 = 3,
  Ul924Stencil = 4,
  Ul924Panel = 5
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
  SignDesign Design = SignDesign::Stencil;
  int Bars = 9;
  /// Width of a bar over that of a bar and a gap.
  double BarFraction = 0.5;
  /// Side of the square over the plate's shorter side.
  double SquareFraction = 0.5;
  std::string PatternFile;
  std::string Text = "EXIT";
  /// Height of letters or pictogram [m]; 0: as large as fits with a margin.
  double FigureHeight = 0.0;
  /// Photometric luminance of lit and unlit parts [cd/m2].
  double Luminance = 300.0;
  double UnlitLuminance = 0.0;
  /// Least over greatest luminance within a part, 0 to 1.
  double Uniformity = 1.0;
  /// Luminance is that along the normal times the cosine to this power.
  double EmissionExponent = 0.0;
  double Colour[3] = {1.0, 1.0, 1.0};
  /// Black: that of the lit parts.
  double UnlitColour[3] = {0.0, 0.0, 0.0};
  double Reflectance = 0.0;
  /// Negative: that of the lit parts.
  double UnlitReflectance = -1.0;

  /// Takes over how a standard wants signs to look; their place and size stay.
  void Apply(SignPreset preset);
};

/// The standard that a preset is from and what it says, in a sentence; empty for Custom.
std::string PresetSource(SignPreset preset);

/// The luminances of the pixels of an image file, linear, 0 to 1, bottom row first.
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

/// Reads a table of signs, a sign a row; what a row does not say comes from its preset, if it names
/// one, and else from `defaults`. The header line names the columns, in any order: cx, cy, cz
/// (needed), id, name, nx, ny, nz, ux, uy, uz, width, height, preset, pattern, design, bars,
/// bar_fraction, square_fraction, pattern_file (relative to the table), text, figure_height,
/// luminance, unlit_luminance, uniformity, exponent, red, green, blue, unlit_red, unlit_green,
/// unlit_blue, reflectance, unlit_reflectance; each means what the property of vtkExitSignSource of
/// that name does. Blank lines and lines that begin with # are left out. Throws Error with the
/// number of the line at fault.
std::vector<SignPlate> ReadSignTable(const std::string& fileName, const SignPlate& defaults);

} // namespace smokevis
