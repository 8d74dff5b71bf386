// A building's geometry as triangles with materials and objects, whatever file it came from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace smokevis
{

using CadPoint = std::array<double, 3>;
using CadColor = std::array<double, 3>;

/// An image that a material has for a colour.
struct CadImage
{
  /// Path of the file; blank where the image came with the model.
  std::string File;
  /// The file's content where the image came with the model.
  std::vector<unsigned char> Bytes;
};

/// How light meets a surface, as far as the file says.
struct CadMaterial
{
  /// Blank where the file names none.
  std::string Name;
  /// Diffuse reflectance, linear red, green and blue, 0 to 1; nothing where the file has no colour.
  std::optional<CadColor> Reflectance;
  /// By whose mean colour the reflectance is to be multiplied.
  std::optional<CadImage> Image;
  /// 0: lets all light through, 1: none.
  double Opacity = 1.0;
};

/// A part of the building that a file tells apart.
struct CadObject
{
  std::string Name;
  /// What the part belongs to, outermost first: assemblies, groups, the product or kind it is of.
  std::vector<std::string> Groups;
};

/// The front is the side from which the corners run anticlockwise.
struct CadTriangle
{
  std::array<std::uint32_t, 3> Corners;
  std::int32_t Material;
  std::int32_t Object;
  /// Reflectance of this triangle alone, from the colours of its corners; below 0 where there are
  /// none and the material's counts.
  std::array<float, 3> Reflectance = {-1.0F, -1.0F, -1.0F};
};

/// The axis of a file that points up.
enum class UpAxis
{
  Automatic = 0,
  X = 1,
  Y = 2,
  Z = 3
};

/// What the numbers of a file's colours mean.
enum class ColorSpace
{
  /// Linear in glTF, as its specification says, else sRGB.
  Automatic = 0,
  /// Values for a screen (IEC 61966-2-1).
  Srgb = 1,
  /// Reflectances.
  Linear = 2
};

/// Who said a thing about a model.
enum class CadSource
{
  Format,
  File,
  User
};

struct CadOptions
{
  /// Length of one unit of the file [m]; 0: what the file says, else what its format is known for.
  double UnitScale = 0.0;
  UpAxis Up = UpAxis::Automatic;
  ColorSpace Colors = ColorSpace::Automatic;
  /// Largest distance of a triangle from the curved surface that it stands for [m].
  double LinearTolerance = 0.005;
  /// Largest angle between neighbouring triangles of a curved surface [degrees].
  double AngularTolerance = 15.0;

  bool operator==(const CadOptions&) const = default;
};

struct CadModel
{
  /// [m], z up.
  std::vector<CadPoint> Points;
  std::vector<CadTriangle> Triangles;
  std::vector<CadMaterial> Materials;
  std::vector<CadObject> Objects;

  /// Name of the file's format.
  std::string Format;
  /// Length of one unit of the file [m] and who said so.
  double UnitScale = 1.0;
  CadSource UnitSource = CadSource::Format;
  /// Which axis of the file points up and who said so.
  UpAxis Up = UpAxis::Z;
  CadSource UpSource = CadSource::Format;
  /// Triangles without area or with coordinates that are not finite, which were left out.
  std::size_t DegenerateTriangles = 0;
  /// What the user should know of, sentences without a full stop.
  std::vector<std::string> Warnings;
};

} // namespace smokevis
