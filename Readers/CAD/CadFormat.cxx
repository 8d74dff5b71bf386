// Tells the format of a CAD file by its name.
#include "CadFormat.h"

#include "Errors.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
const std::vector<CadFormat>& CadFormats()
{
  // glTF is in metres with y up by its specification. OBJ is mostly written with y up. COLLADA,
  // FBX, IFC, STEP, IGES and most DXF files state what they are in; the defaults here are those of
  // their specifications.
  static const std::vector<CadFormat> formats = {
    {"STEP", "step stp", CadLibrary::BRep, 0.001, UpAxis::Z, false},
    {"IGES", "iges igs", CadLibrary::BRep, 0.0254, UpAxis::Z, false},
    {"OBJ", "obj", CadLibrary::Mesh, 1.0, UpAxis::Y, false},
    {"STL", "stl", CadLibrary::Mesh, 1.0, UpAxis::Z, false},
    {"PLY", "ply", CadLibrary::Mesh, 1.0, UpAxis::Z, false},
    {"glTF", "gltf glb", CadLibrary::Mesh, 1.0, UpAxis::Y, true},
    {"COLLADA", "dae", CadLibrary::Mesh, 1.0, UpAxis::Y, false},
    {"FBX", "fbx", CadLibrary::Mesh, 0.01, UpAxis::Y, false},
    {"3DS", "3ds", CadLibrary::Mesh, 1.0, UpAxis::Z, false},
    {"DXF", "dxf", CadLibrary::Mesh, 1.0, UpAxis::Z, false},
    {"IFC", "ifc", CadLibrary::Mesh, 1.0, UpAxis::Z, false},
  };
  return formats;
}

//------------------------------------------------------------------------------------------------
const CadFormat& FormatOfFile(const std::string& fileName)
{
  std::string extension = std::filesystem::path(fileName).extension().string();
  extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const CadFormat& format : CadFormats())
  {
    std::istringstream extensions{std::string(format.Extensions)};
    for (std::string candidate; extensions >> candidate;)
    {
      if (candidate == extension)
      {
        return format;
      }
      known += (known.empty() ? "." : ", .") + candidate;
    }
  }
  throw Error(fileName,
    extension.empty() ? "its name has no extension that tells the format"
                      : "files with the extension ." + extension + " cannot be read",
    "Convert it to one of " + known);
}

} // namespace smokevis
