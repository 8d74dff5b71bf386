// Reads meshes through assimp.
#include "MeshModel.h"

#include "ColladaNumbers.h"
#include "Errors.h"
#include "FileBytes.h"
#include "FileEnd.h"
#include "FileHeader.h"
#include "Ifc4Rewriter.h"
#include "MeshImport.h"
#include "ObjRewriter.h"
#include "PlyFile.h"
#include "SrgbColor.h"

#include <assimp/material.h>
#include <assimp/matrix4x4.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

namespace smokevis
{
namespace
{

using Matrix = aiMatrix4x4t<double>;

/// Turns an imported scene into a model.
class SceneConverter
{
public:
  SceneConverter(const aiScene& scene, const std::string& fileName, const CadFormat& format,
    const CadOptions& options, bool materialsMissing, CadModel& model)
      : Scene_(scene), Folder_(std::filesystem::path(fileName).parent_path()), Format_(format),
        MaterialsMissing_(materialsMissing), Model_(model),
        Linear_(options.Colors == ColorSpace::Linear ||
                (options.Colors == ColorSpace::Automatic && format.LinearColors))
  {
  }

  /// @param toFile from the library's coordinates to those of the file
  void Convert(const Matrix& toFile)
  {
    for (unsigned int i = 0; i < this->Scene_.mNumMaterials; ++i)
    {
      this->AddMaterial(*this->Scene_.mMaterials[i]);
    }
    std::vector<std::string> groups;
    this->AddNode(*this->Scene_.mRootNode, toFile, groups);
  }

private:
  CadColor Reflectance(double r, double g, double b) const
  {
    CadColor color = {r, g, b};
    for (double& part : color)
    {
      part = std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.0;
      part = this->Linear_ ? part : LinearFromSrgb(part);
    }
    return color;
  }

  /// Whether the library made a material up for want of one.
  bool IsMadeUp(const std::string& name, const aiColor4D& color) const
  {
    if (name.empty())
    {
      return color.r == 1.0F && color.g == 1.0F && color.b == 1.0F;
    }
    constexpr float grey = 0.6F;
    if (this->MaterialsMissing_ && color.r == grey && color.g == grey && color.b == grey)
    {
      return true;
    }
    return name == AI_DEFAULT_MATERIAL_NAME || name == "<IFCDefault>" || name == "%%%DEFAULT";
  }

  void AddMaterial(const aiMaterial& source)
  {
    CadMaterial material;
    aiString name;
    if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS)
    {
      material.Name = name.C_Str();
    }
    aiColor4D color;
    const bool colored = source.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
                         source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
    if (colored && !this->IsMadeUp(material.Name, color))
    {
      material.Reflectance = this->Reflectance(color.r, color.g, color.b);
    }
    this->AddImage(source, material);
    float opacity = 1.0F;
    if (source.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && std::isfinite(opacity))
    {
      material.Opacity = std::clamp(opacity, 0.0F, 1.0F);
    }
    if (material.Name == AI_DEFAULT_MATERIAL_NAME || material.Name == "<IFCDefault>")
    {
      material.Name.clear();
    }
    this->Model_.Materials.push_back(std::move(material));
  }

  void AddImage(const aiMaterial& source, CadMaterial& material) const
  {
    aiString name;
    if (source.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != aiReturn_SUCCESS &&
        source.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS)
    {
      return;
    }
    CadImage image;
    if (const aiTexture* const texture = this->Scene_.GetEmbeddedTexture(name.C_Str()))
    {
      // With a height it is a raster, for which no exporter is known.
      const auto* const bytes = reinterpret_cast<const unsigned char*>(texture->pcData);
      image.Bytes.assign(bytes, bytes + (texture->mHeight == 0 ? texture->mWidth : 0));
    }
    else
    {
      std::string file = name.C_Str();
      std::replace(file.begin(), file.end(), '\\', '/');
      image.File = (this->Folder_ / file).string();
    }
    // In glTF and OBJ colour and image are multiplied, elsewhere the image takes its place.
    if (this->Format_.Name != "glTF" && this->Format_.Name != "OBJ")
    {
      material.Reflectance.reset();
    }
    material.Image = std::move(image);
  }

  void AddNode(const aiNode& node, const Matrix& parent, std::vector<std::string>& groups)
  {
    const Matrix toFile = parent * Matrix(node.mTransformation);
    const bool isRoot = node.mParent == nullptr;
    CadObject object = this->ObjectOf(node, groups);
    for (unsigned int i = 0; i < node.mNumMeshes; ++i)
    {
      const aiMesh& mesh = *this->Scene_.mMeshes[node.mMeshes[i]];
      CadObject part = object;
      if (part.Name.empty() || isRoot)
      {
        part.Name = mesh.mName.C_Str();
      }
      if (i == 0 || this->Model_.Objects.back().Name != part.Name)
      {
        this->Model_.Objects.push_back(std::move(part));
      }
      this->AddMesh(mesh, toFile);
    }
    const bool named = !isRoot && !object.Name.empty() && object.Name[0] != '$';
    if (named)
    {
      groups.push_back(object.Name);
    }
    for (unsigned int i = 0; i < node.mNumChildren; ++i)
    {
      this->AddNode(*node.mChildren[i], toFile, groups);
    }
    if (named)
    {
      groups.pop_back();
    }
  }

  /// IFC nodes are called Class_Name_GlobalId, with an id of 22 characters.
  CadObject ObjectOf(const aiNode& node, const std::vector<std::string>& groups) const
  {
    CadObject object{node.mName.C_Str(), groups};
    constexpr std::size_t idLength = 22;
    const std::size_t first = object.Name.find('_');
    if (this->Format_.Name == "IFC" && object.Name.compare(0, 3, "Ifc") == 0 &&
        first != std::string::npos && object.Name.size() > first + idLength + 1)
    {
      const std::string kind = object.Name.substr(0, first);
      const std::size_t last = object.Name.size() - idLength - 1;
      const std::string name =
        last > first + 1 ? object.Name.substr(first + 1, last - first - 1) : std::string();
      object.Groups.push_back(kind);
      object.Name = name.empty() || name == "Unnamed" ? kind : name;
    }
    return object;
  }

  void AddMesh(const aiMesh& mesh, const Matrix& toFile)
  {
    std::vector<CadPoint>& points = this->Model_.Points;
    const std::size_t first = points.size();
    if (first + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max())
    {
      throw Error("mesh", "it has more points than can be numbered", "Export parts of it");
    }
    for (unsigned int i = 0; i < mesh.mNumVertices; ++i)
    {
      const aiVector3t<double> point =
        toFile * aiVector3t<double>(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
      points.push_back({point.x, point.y, point.z});
    }
    const bool mirrored = toFile.Determinant() < 0.0;
    const auto offset = static_cast<std::uint32_t>(first);
    const auto material = static_cast<std::int32_t>(mesh.mMaterialIndex);
    const auto object = static_cast<std::int32_t>(this->Model_.Objects.size()) - 1;
    for (unsigned int i = 0; i < mesh.mNumFaces; ++i)
    {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3)
      {
        continue;
      }
      CadTriangle triangle{
        {offset + face.mIndices[0], offset + face.mIndices[1], offset + face.mIndices[2]}, material,
        object};
      if (mirrored)
      {
        std::swap(triangle.Corners[1], triangle.Corners[2]);
      }
      // Those of DXF are numbers of pens.
      if (mesh.mColors[0] && this->Format_.Name != "DXF")
      {
        this->AddVertexColors(mesh, face, triangle);
      }
      this->Model_.Triangles.push_back(triangle);
    }
  }

  /// Colours of corners count where the material has none; in glTF the two are multiplied.
  void AddVertexColors(const aiMesh& mesh, const aiFace& face, CadTriangle& triangle) const
  {
    const auto& own = this->Model_.Materials[mesh.mMaterialIndex].Reflectance;
    if (own && !this->Format_.LinearColors)
    {
      return;
    }
    std::array<double, 3> mean{};
    for (unsigned int i = 0; i < 3; ++i)
    {
      const aiColor4D& color = mesh.mColors[0][face.mIndices[i]];
      const CadColor linear = this->Reflectance(color.r, color.g, color.b);
      for (int part = 0; part < 3; ++part)
      {
        mean[part] += linear[part] * (own ? (*own)[part] : 1.0) / 3.0;
      }
    }
    for (int part = 0; part < 3; ++part)
    {
      triangle.Reflectance[part] = static_cast<float>(mean[part]);
    }
  }

  const aiScene& Scene_;
  std::filesystem::path Folder_;
  const CadFormat& Format_;
  bool MaterialsMissing_;
  CadModel& Model_;
  bool Linear_;
};

/// What the file states, and the matrix from the library's coordinates to those of the file.
Matrix ReadHeader(
  const std::string& fileName, const CadFormat& format, const aiScene& scene, CadModel& model)
{
  FileHeader header;
  double libraryScale = 1.0;
  bool turned = false;
  if (format.Name == "COLLADA")
  {
    header = ReadColladaHeader(fileName);
    libraryScale = header.UnitScale > 0.0 ? header.UnitScale : 1.0;
  }
  else if (format.Name == "IFC")
  {
    header = ReadIfcHeader(fileName);
    // The library applies the prefixes of metres and no other units.
    const double power = std::log10(header.UnitScale);
    const bool prefixed = header.UnitScale > 0.0 && std::abs(power - std::round(power)) < 1e-9;
    libraryScale = prefixed ? header.UnitScale : 1.0;
    turned = true;
  }
  else if (format.Name == "DXF")
  {
    header = ReadDxfHeader(fileName);
    turned = true;
  }
  else if (format.Name == "3DS")
  {
    turned = true;
  }
  else if (format.Name == "FBX" && scene.mMetaData)
  {
    float centimetres = 0.0F;
    int axis = -1;
    if (scene.mMetaData->Get("UnitScaleFactor", centimetres))
    {
      header.UnitScale = 0.01 * centimetres;
    }
    if (scene.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis <= 2)
    {
      header.Up = static_cast<UpAxis>(axis + 1);
    }
  }
  if (header.UnitScale > 0.0)
  {
    model.UnitScale = header.UnitScale;
    model.UnitSource = CadSource::File;
  }
  if (header.Up != UpAxis::Automatic)
  {
    model.Up = header.Up;
    model.UpSource = CadSource::File;
  }
  const double s = 1.0 / libraryScale;
  // The library turns some formats to y up: (x, y, z) of the file comes as (x, z, -y).
  return turned ? Matrix(s, 0, 0, 0, 0, 0, -s, 0, 0, s, 0, 0, 0, 0, 0, 1)
                : Matrix(s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1);
}

} // namespace

//------------------------------------------------------------------------------------------------
void ReadMeshModel(const std::string& fileName, const CadFormat& format, const CadOptions& options,
  Progress& progress, CadModel& model)
{
  const bool lines = format.Name == "PLY" ? CheckPlyFile(fileName) : format.Name == "OBJ";
  if (lines && EndsInsideLine(fileName))
  {
    model.Warnings.emplace_back("the last line of the file has no end: it may be cut short, which "
                                "the format does not tell");
  }
  if (format.Name == "COLLADA")
  {
    CheckColladaNumbers(fileName);
  }
  std::string rewritten;
  if (format.Name == "IFC")
  {
    std::size_t unread = 0;
    rewritten = RewriteIfc4(FileBytes(fileName), options.AngularTolerance, unread);
    if (unread > 0)
    {
      model.Warnings.push_back(std::to_string(unread) +
                               " shapes of IFC4, such as IfcAdvancedBrep, are not read and are "
                               "missing; export tessellated "
                               "geometry or IFC2x3");
    }
  }
  else if (format.Name == "OBJ")
  {
    rewritten = RewriteObj(FileBytes(fileName));
  }
  const MeshImport import(fileName, format, std::move(rewritten), progress);
  if (progress.ShouldStop())
  {
    return;
  }
  for (const std::string& file : import.Missing())
  {
    model.Warnings.push_back(
      "the file '" + file +
      "' that the model refers to is missing beside it, so colours may be missing");
  }
  const aiScene& scene = import.Scene();
  const Matrix toFile = ReadHeader(fileName, format, scene, model);
  SceneConverter(scene, fileName, format, options, !import.Missing().empty(), model)
    .Convert(toFile);
}

} // namespace smokevis
