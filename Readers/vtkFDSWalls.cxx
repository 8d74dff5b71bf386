#include "vtkFDSWalls.h"

#include "Errors.h"
#include "GeomFile.h"
#include "SmvFile.h"
#include "SrgbColor.h"
#include "WallBuilder.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReader2.h"
#include "vtkImageReader2Factory.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>

namespace smokevis
{

namespace
{

using Reflectance = std::array<float, 3>;

Reflectance LinearColor(const std::array<double, 3>& color)
{
  Reflectance linear{};
  std::transform(color.begin(), color.end(), linear.begin(),
    [](double part) { return static_cast<float>(LinearFromSrgb(part)); });
  return linear;
}

// The mean reflectance of an image, or nothing where it cannot be read.
std::optional<Reflectance> MeanColor(const std::string& path)
{
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem))
  {
    return std::nullopt;
  }
  const auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(path.c_str()));
  if (!reader)
  {
    return std::nullopt;
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkDataArray* const pixels = reader->GetOutput()->GetPointData()->GetScalars();
  if (!pixels || pixels->GetNumberOfTuples() == 0)
  {
    return std::nullopt;
  }
  const double white = pixels->GetDataTypeMax();
  const int components = pixels->GetNumberOfComponents();
  std::array<double, 3> sum{};
  for (vtkIdType pixel = 0; pixel < pixels->GetNumberOfTuples(); ++pixel)
  {
    for (int part = 0; part < 3; ++part)
    {
      // Grey images have one component, or two with an alpha.
      const double value = pixels->GetComponent(pixel, components < 3 ? 0 : part);
      sum[part] += LinearFromSrgb(value / white);
    }
  }
  Reflectance mean{};
  std::transform(sum.begin(), sum.end(), mean.begin(),
    [pixels](double part)
    { return static_cast<float>(part / static_cast<double>(pixels->GetNumberOfTuples())); });
  return mean;
}

// Walls in the making.
class Walls
{
public:
  explicit Walls(const SmvFile& index) : index_(index)
  {
    points_->SetDataTypeToDouble();
    reflectance_->SetName("Reflectance");
    reflectance_->SetNumberOfComponents(3);
    names_->SetName("SurfaceName");
  }

  vtkPoints* Points() { return points_; }

  template <std::size_t N>
  void AddPolygon(const std::array<vtkIdType, N>& corners, int surface, const Reflectance& color)
  {
    polygons_->InsertNextCell(static_cast<vtkIdType>(N), corners.data());
    reflectance_->InsertNextTypedTuple(color.data());
    names_->InsertNextValue(index_.Surfaces[surface].Name);
  }

  // The reflectance of a surface that shows its own colour or texture.
  const Reflectance& OfSurface(int surface)
  {
    const auto known = colors_.find(surface);
    if (known != colors_.end())
    {
      return known->second;
    }
    const SmvSurface& one = index_.Surfaces[surface];
    std::optional<Reflectance> color =
      one.Texture.empty() ? std::nullopt : MeanColor(index_.Resolve(one.Texture));
    return colors_
      .emplace(surface, color.value_or(LinearColor({one.Color[0], one.Color[1], one.Color[2]})))
      .first->second;
  }

  void MoveTo(vtkPolyData* output)
  {
    output->SetPoints(points_);
    output->SetPolys(polygons_);
    output->GetCellData()->AddArray(reflectance_);
    output->GetCellData()->AddArray(names_);
  }

private:
  const SmvFile& index_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> polygons_;
  vtkNew<vtkFloatArray> reflectance_;
  vtkNew<vtkStringArray> names_;
  std::map<int, Reflectance> colors_;
};

void AddObstructions(WallBuilder& builder, const SmvFile& index, Walls& walls)
{
  for (const WallQuad& quad : builder.Build())
  {
    std::array<vtkIdType, 4> corners{};
    const auto places = quad.Corners();
    std::transform(places.begin(), places.end(), corners.begin(),
      [&walls](const auto& place) { return walls.Points()->InsertNextPoint(place.data()); });
    const WallMaterial& material = builder.Materials()[quad.Material];
    const auto& own = index.Surfaces[material.Surface].Color;
    const bool ofSurface = material.Color == std::array<double, 3>{own[0], own[1], own[2]};
    walls.AddPolygon(corners, material.Surface,
      ofSurface ? walls.OfSurface(material.Surface) : LinearColor(material.Color));
  }
}

void AddGeometry(
  GeomFile& file, const SmvFile& index, double time, double leastOpacity, Walls& walls)
{
  const GeomTriangles triangles = file.Read(time);
  const vtkIdType first = walls.Points()->GetNumberOfPoints();
  for (const auto& point : triangles.Points)
  {
    walls.Points()->InsertNextPoint(point.data());
  }
  for (std::size_t i = 0; i < triangles.Triangles.size(); ++i)
  {
    const auto last = static_cast<int>(index.Surfaces.size()) - 1;
    const int surface = std::clamp(triangles.Surfaces[i], 0, last);
    if (index.Surfaces[surface].Color[3] < leastOpacity)
    {
      continue;
    }
    const auto& [a, b, c] = triangles.Triangles[i];
    walls.AddPolygon(
      std::array<vtkIdType, 3>{first + a, first + b, first + c}, surface, walls.OfSurface(surface));
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
WallReport BuildWalls(const SmvFile& index, double time, double leastOpacity, vtkPolyData* output)
{
  WallReport report;
  Walls walls(index);
  WallBuilder builder(index, time, leastOpacity);
  AddObstructions(builder, index, walls);
  report.Mirrors = builder.FoundMirror();
  bool found = false;
  for (const bool cutFaces : {false, true})
  {
    for (const SmvGeometry& geometry : index.Geometries)
    {
      if (geometry.CutFaces != cutFaces || (cutFaces && found))
      {
        continue;
      }
      try
      {
        GeomFile file(index.Resolve(geometry.File), cutFaces);
        AddGeometry(file, index, time, leastOpacity, walls);
        found = true;
        report.Moves = report.Moves || file.Moves();
        if (!file.Damage().empty())
        {
          report.Warnings.push_back(file.Path() + ": " + file.Damage());
        }
      }
      catch (const Error& error)
      {
        report.Warnings.push_back(std::string("Geometry is missing. ") + error.what());
      }
    }
  }
  walls.MoveTo(output);
  return report;
}

} // namespace smokevis
