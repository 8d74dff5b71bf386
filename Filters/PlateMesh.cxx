// Plane plates of signs and lamps as polydata.
#include "PlateMesh.h"

#include "Errors.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>

namespace smokevis
{
namespace
{

bool Finite(const Vec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Lines of a cut without those that coincide.
std::vector<double> Distinct(const std::vector<double>& lines)
{
  std::vector<double> result;
  const double size = lines.back() - lines.front();
  for (const double line : lines)
  {
    if (result.empty() || line - result.back() > 1e-12 * size)
    {
      result.push_back(line);
    }
  }
  return result;
}

bool Coloured(const Spectrum& value)
{
  return value[0] != value[1] || value[0] != value[2];
}

template <class Array>
vtkSmartPointer<Array> AddArray(
  vtkCellData& data, const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  data.AddArray(array);
  return array;
}

/// Bands in the ratios of a colour whose weighted mean is a value.
Spectrum Tint(double value, const double colour[3], const std::string& name)
{
  for (int band = 0; band < 3; ++band)
  {
    if (!(colour[band] >= 0.0 && colour[band] <= 1.0))
    {
      throw Error(name, "its Color has a component outside 0 to 1",
        "Give linear red, green and blue between 0 and 1");
    }
  }
  if (colour[0] == colour[1] && colour[0] == colour[2] && colour[0] > 0.0)
  {
    return {value, value, value};
  }
  const double weight = PhotopicWeights[0] * colour[0] + PhotopicWeights[1] * colour[1] +
                        PhotopicWeights[2] * colour[2];
  if (!(weight > 0.0))
  {
    throw Error(name, "its Color is black", "Set the luminance to 0 for an unlit plate");
  }
  return {value * colour[0] / weight, value * colour[1] / weight, value * colour[2] / weight};
}

} // namespace

//------------------------------------------------------------------------------
PlateFrame PlateFrame::Make(
  const Vec3& centre, const Vec3& normal, const Vec3& up, const std::string& name)
{
  if (!Finite(centre))
  {
    throw Error(name, "its centre is not finite", "Give a Center in metres");
  }
  const double normalLength = glm::length(normal);
  const double upLength = glm::length(up);
  if (!(normalLength > 0.0) || !std::isfinite(normalLength))
  {
    throw Error(name, "its normal has no direction", "Give a Normal other than (0, 0, 0)");
  }
  if (!(upLength > 0.0) || !std::isfinite(upLength))
  {
    throw Error(name, "its up vector has no direction", "Give an Up other than (0, 0, 0)");
  }
  PlateFrame frame;
  frame.Centre = centre;
  frame.Normal = normal / normalLength;
  Vec3 right(0.0);
  for (const Vec3& candidate : {up / upLength, Vec3(0.0, 1.0, 0.0), Vec3(1.0, 0.0, 0.0)})
  {
    right = glm::cross(candidate, frame.Normal);
    if (glm::length(right) > 1e-6)
    {
      break;
    }
  }
  frame.Right = glm::normalize(right);
  frame.Up = glm::cross(frame.Normal, frame.Right);
  return frame;
}

//------------------------------------------------------------------------------
void PlateMesh::Add(const Plate& plate, const std::vector<double>& u, const std::vector<double>& v,
  const std::function<CellLook(std::size_t, std::size_t)>& look)
{
  const std::vector<double> columns = Distinct(u);
  const std::vector<double> rows = Distinct(v);
  // A cell's look is asked for by its place in the lattice as it was given.
  const auto given = [](const std::vector<double>& lines, double middle)
  {
    return static_cast<std::size_t>(
      std::upper_bound(lines.begin(), lines.end(), middle) - lines.begin() - 1);
  };
  const auto first = static_cast<vtkIdType>(this->Points_.size());
  for (const double y : rows)
  {
    for (const double x : columns)
    {
      this->Points_.push_back(plate.Frame.Centre + x * plate.Frame.Right + y * plate.Frame.Up);
    }
  }
  const auto stride = static_cast<vtkIdType>(columns.size());
  for (std::size_t j = 0; j + 1 < rows.size(); ++j)
  {
    for (std::size_t i = 0; i + 1 < columns.size(); ++i)
    {
      const vtkIdType corner =
        first + static_cast<vtkIdType>(i) + stride * static_cast<vtkIdType>(j);
      this->Cells_.push_back({{corner, corner + 1, corner + stride + 1, corner + stride},
        look(
          given(u, 0.5 * (columns[i] + columns[i + 1])), given(v, 0.5 * (rows[j] + rows[j + 1]))),
        this->Plates_.size()});
    }
  }
  this->Plates_.push_back(plate);
}

//------------------------------------------------------------------------------
void PlateMesh::Add(const Plate& plate, const std::vector<PlateCell>& cells)
{
  for (const PlateCell& cell : cells)
  {
    std::vector<vtkIdType> corners;
    for (const glm::dvec2& corner : cell.Corners)
    {
      corners.push_back(static_cast<vtkIdType>(this->Points_.size()));
      this->Points_.push_back(
        plate.Frame.Centre + corner.x * plate.Frame.Right + corner.y * plate.Frame.Up);
    }
    this->Cells_.push_back({std::move(corners), cell.Look, this->Plates_.size()});
  }
  this->Plates_.push_back(plate);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> PlateMesh::Finish() const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points_.size()));
  for (std::size_t i = 0; i < this->Points_.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), &this->Points_[i].x);
  }

  const auto cells = static_cast<vtkIdType>(this->Cells_.size());
  const auto anyLook = [this](Spectrum CellLook::*value)
  {
    return std::any_of(this->Cells_.begin(), this->Cells_.end(),
      [value](const Cell& cell) { return Coloured(cell.Look.*value); });
  };
  const auto anyPlate = [this](auto&& test)
  { return std::any_of(this->Plates_.begin(), this->Plates_.end(), test); };

  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkCellData* const data = result->GetCellData();
  const auto luminance =
    AddArray<vtkDoubleArray>(*data, "Luminance", anyLook(&CellLook::Luminance) ? 3 : 1, cells);
  const auto signId = AddArray<vtkIntArray>(*data, "SignId", 1, cells);
  const auto reflectance =
    AddArray<vtkDoubleArray>(*data, "Reflectance", anyLook(&CellLook::Reflectance) ? 3 : 1, cells);
  vtkSmartPointer<vtkIntArray> part;
  if (anyPlate([](const Plate& plate) { return plate.SignId >= 0; }))
  {
    part = AddArray<vtkIntArray>(*data, "SignPart", 1, cells);
  }
  vtkSmartPointer<vtkDoubleArray> exponent;
  if (anyPlate([](const Plate& plate) { return plate.Exponent != 0.0; }))
  {
    exponent = AddArray<vtkDoubleArray>(*data, "EmissionExponent", 1, cells);
  }
  vtkSmartPointer<vtkStringArray> names;
  if (anyPlate([](const Plate& plate) { return !plate.Name.empty(); }))
  {
    names = AddArray<vtkStringArray>(*data, "SignName", 1, cells);
  }

  vtkNew<vtkCellArray> polys;
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const Cell& cell = this->Cells_[i];
    const Plate& plate = this->Plates_[cell.Plate];
    polys->InsertNextCell(static_cast<vtkIdType>(cell.Corners.size()), cell.Corners.data());
    luminance->SetTuple(i, cell.Look.Luminance.data());
    signId->SetValue(i, plate.SignId);
    reflectance->SetTuple(i, cell.Look.Reflectance.data());
    if (part)
    {
      part->SetValue(i, cell.Look.Lit ? 1 : 0);
    }
    if (exponent)
    {
      exponent->SetValue(i, plate.Exponent);
    }
    if (names)
    {
      names->SetValue(i, plate.Name);
    }
  }
  result->SetPoints(points);
  result->SetPolys(polys);
  // ParaView colours by it.
  data->SetActiveScalars("Luminance");
  return result;
}

//------------------------------------------------------------------------------
Spectrum ColouredLuminance(double luminance, const double colour[3], const std::string& name)
{
  if (!(luminance >= 0.0) || !std::isfinite(luminance))
  {
    throw Error(
      name, "its luminance is negative or not finite", "Give a luminance in cd/m2, from 0");
  }
  return Tint(luminance, colour, name);
}

//------------------------------------------------------------------------------
Spectrum ColouredReflectance(double reflectance, const double colour[3], const std::string& name)
{
  if (!(reflectance >= 0.0 && reflectance <= 1.0))
  {
    throw Error(name, "its reflectance is outside 0 to 1", "Give a diffuse reflectance");
  }
  const Spectrum bands = Tint(reflectance, colour, name);
  if (*std::max_element(bands.begin(), bands.end()) > 1.0 + 1e-9)
  {
    throw Error(name, "nothing of its colour reflects as much light as its reflectance says",
      "Give a paler colour or a lower reflectance: pure red at most 0.21, green 0.71, blue 0.07");
  }
  return bands;
}

} // namespace smokevis
