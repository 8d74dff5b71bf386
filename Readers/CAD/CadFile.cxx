// Hands a CAD file to the library that reads its format, and brings what comes back to metres with
// z up.
#include "CadFile.h"

#include "BRepModel.h"
#include "CadFormat.h"
#include "Errors.h"
#include "FileEnd.h"
#include "MeshModel.h"
#include "PrintableText.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace smokevis
{
namespace
{

/// Twice the area of a triangle over the square of its longest edge, below which its direction is
/// rounding noise.
constexpr double FlatLimit = 1e-12;

CadPoint ZUp(const CadPoint& point, UpAxis up)
{
  switch (up)
  {
  case UpAxis::X:
    return {point[1], point[2], point[0]};
  case UpAxis::Y:
    return {point[0], -point[2], point[1]};
  default:
    return point;
  }
}

bool IsDegenerate(const CadPoint& a, const CadPoint& b, const CadPoint& c)
{
  CadPoint u, v;
  double lengths[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i)
  {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
    lengths[0] += u[i] * u[i];
    lengths[1] += v[i] * v[i];
    lengths[2] += (c[i] - b[i]) * (c[i] - b[i]);
  }
  const double longest = *std::max_element(lengths, lengths + 3);
  const double area =
    std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  // Also true for what is not finite.
  return !(area > FlatLimit * longest) || !std::isfinite(area);
}

void DropDegenerate(CadModel& model)
{
  const auto flat = [&](const CadTriangle& triangle)
  {
    return IsDegenerate(model.Points[triangle.Corners[0]], model.Points[triangle.Corners[1]],
      model.Points[triangle.Corners[2]]);
  };
  model.DegenerateTriangles += std::erase_if(model.Triangles, flat);
}

void CheckFile(const std::string& fileName)
{
  std::error_code problem;
  const auto status = std::filesystem::status(fileName, problem);
  if (!std::filesystem::exists(status))
  {
    throw Error(fileName, "there is no such file", "Check the path and its spelling");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw Error(fileName, "it is not a file", "Give the path of a CAD file");
  }
  if (std::filesystem::file_size(fileName, problem) == 0)
  {
    throw Error(fileName, "the file is empty", "Export the model again");
  }
}

void CheckOptions(const CadOptions& options)
{
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (options.UnitScale != 0.0 && !positive(options.UnitScale))
  {
    throw Error("UnitScale", "it is not a positive number",
      "Give the length of one unit of the file in metres, such as 0.001, or 0 for automatic");
  }
  // Finer ones ask for more triangles than there is memory.
  constexpr double finest = 1e-6;
  if (!positive(options.LinearTolerance) || options.LinearTolerance < finest)
  {
    throw Error("LinearTolerance", "it is not a positive number of at least 1e-6 m",
      "Give a length in metres, such as 0.005");
  }
  if (!(options.AngularTolerance >= 0.5 && options.AngularTolerance <= 90.0))
  {
    throw Error("AngularTolerance", "it is not from 0.5 to 90 degrees", "Give degrees, such as 15");
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
CadModel ReadCadFile(const std::string& fileName, const CadOptions& options, Progress& progress)
{
  CheckOptions(options);
  const CadFormat& format = FormatOfFile(fileName);
  CheckFile(fileName);
  CheckFileEnd(fileName, format.Name);

  CadModel model;
  model.Format = format.Name;
  model.UnitScale = format.UnitScale;
  model.Up = format.Up;
  if (format.Library == CadLibrary::BRep)
  {
    ReadBRepModel(fileName, options, progress, model);
  }
  else
  {
    ReadMeshModel(fileName, format, options, progress, model);
  }
  if (progress.ShouldStop())
  {
    throw Error(fileName, "reading was stopped");
  }

  if (options.UnitScale > 0.0)
  {
    model.UnitScale = options.UnitScale;
    model.UnitSource = CadSource::User;
  }
  if (options.Up != UpAxis::Automatic)
  {
    model.Up = options.Up;
    model.UpSource = CadSource::User;
  }
  double farthest = 0.0;
  for (CadPoint& point : model.Points)
  {
    for (double& value : point)
    {
      value *= model.UnitScale;
      farthest = std::max(farthest, std::abs(value));
    }
    point = ZUp(point, model.Up);
  }
  for (CadMaterial& material : model.Materials)
  {
    material.Name = Printable(material.Name);
  }
  for (CadObject& object : model.Objects)
  {
    object.Name = Printable(object.Name);
  }
  DropDegenerate(model);
  if (model.Triangles.empty())
  {
    throw Error(fileName,
      model.DegenerateTriangles > 0
        ? "all of its " + std::to_string(model.DegenerateTriangles) + " triangles are degenerate"
        : "it holds no surfaces, only points, lines, curves or nothing",
      "Export faces or solids");
  }
  // Meshes come in single precision: far from the origin it is too coarse for a sign.
  constexpr double finest = 0.001;
  const double step = farthest * std::numeric_limits<float>::epsilon();
  if (format.Library == CadLibrary::Mesh && step > finest)
  {
    model.Warnings.push_back(
      "the model is " + std::to_string(std::lround(farthest)) +
      " m from the origin, where coordinates in single precision are " +
      std::to_string(std::lround(1000.0 * step)) +
      " mm apart; export it closer to the origin and move it with Translation");
  }
  return model;
}

} // namespace smokevis
