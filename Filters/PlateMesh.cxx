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
  const std::function<Spectrum(std::size_t, std::size_t)>& luminance)
{
  const std::vector<double> columns = Distinct(u);
  const std::vector<double> rows = Distinct(v);
  // A cell's luminance is asked for by its place in the lattice as it was given.
  const auto given = [](const std::vector<double>& lines, double middle)
  {
    return static_cast<std::size_t>(
      std::upper_bound(lines.begin(), lines.end(), middle) - lines.begin() - 1);
  };
  const auto first = static_cast<std::int64_t>(this->Points_.size());
  for (const double y : rows)
  {
    for (const double x : columns)
    {
      this->Points_.push_back(plate.Frame.Centre + x * plate.Frame.Right + y * plate.Frame.Up);
    }
  }
  const auto stride = static_cast<std::int64_t>(columns.size());
  for (std::size_t j = 0; j + 1 < rows.size(); ++j)
  {
    for (std::size_t i = 0; i + 1 < columns.size(); ++i)
    {
      const std::int64_t corner =
        first + static_cast<std::int64_t>(i) + stride * static_cast<std::int64_t>(j);
      this->Cells_.push_back({{corner, corner + 1, corner + stride + 1, corner + stride},
        luminance(
          given(u, 0.5 * (columns[i] + columns[i + 1])), given(v, 0.5 * (rows[j] + rows[j + 1]))),
        this->Plates_.size()});
    }
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
  const bool coloured = std::any_of(this->Cells_.begin(), this->Cells_.end(),
    [](const Cell& cell)
    { return cell.Luminance[0] != cell.Luminance[1] || cell.Luminance[0] != cell.Luminance[2]; });
  const bool named = std::any_of(this->Plates_.begin(), this->Plates_.end(),
    [](const Plate& plate) { return !plate.Name.empty(); });

  vtkNew<vtkCellArray> polys;
  polys->AllocateExact(cells, 4 * cells);
  vtkNew<vtkDoubleArray> luminance;
  luminance->SetName("Luminance");
  luminance->SetNumberOfComponents(coloured ? 3 : 1);
  luminance->SetNumberOfTuples(cells);
  vtkNew<vtkIntArray> signId;
  signId->SetName("SignId");
  signId->SetNumberOfTuples(cells);
  vtkNew<vtkDoubleArray> reflectance;
  reflectance->SetName("Reflectance");
  reflectance->SetNumberOfTuples(cells);
  vtkNew<vtkStringArray> names;
  names->SetName("SignName");
  names->SetNumberOfValues(named ? cells : 0);
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const Cell& cell = this->Cells_[i];
    const Plate& plate = this->Plates_[cell.Plate];
    const vtkIdType corners[4] = {
      cell.Corners[0], cell.Corners[1], cell.Corners[2], cell.Corners[3]};
    polys->InsertNextCell(4, corners);
    luminance->SetTuple(i, cell.Luminance.data());
    signId->SetValue(i, plate.SignId);
    reflectance->SetValue(i, plate.Reflectance);
    if (named)
    {
      names->SetValue(i, plate.Name);
    }
  }

  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(polys);
  result->GetCellData()->AddArray(luminance);
  result->GetCellData()->AddArray(signId);
  result->GetCellData()->AddArray(reflectance);
  if (named)
  {
    result->GetCellData()->AddArray(names);
  }
  return result;
}

//------------------------------------------------------------------------------
Spectrum ColouredLuminance(double luminance, const double colour[3], const std::string& name)
{
  for (int band = 0; band < 3; ++band)
  {
    if (!(colour[band] >= 0.0 && colour[band] <= 1.0))
    {
      throw Error(name, "its Color has a component outside 0 to 1",
        "Give linear red, green and blue between 0 and 1");
    }
  }
  if (!(luminance >= 0.0) || !std::isfinite(luminance))
  {
    throw Error(
      name, "its luminance is negative or not finite", "Give a luminance in cd/m2, from 0");
  }
  if (colour[0] == colour[1] && colour[0] == colour[2] && colour[0] > 0.0)
  {
    return {luminance, luminance, luminance};
  }
  const double weight = PhotopicWeights[0] * colour[0] + PhotopicWeights[1] * colour[1] +
                        PhotopicWeights[2] * colour[2];
  if (!(weight > 0.0))
  {
    throw Error(name, "its Color is black", "Set the luminance to 0 for an unlit plate");
  }
  return {
    luminance * colour[0] / weight, luminance * colour[1] / weight, luminance * colour[2] / weight};
}

} // namespace smokevis
