// Cuts surfaces into patches.
#include "SurfaceRefiner.h"

#include "Errors.h"
#include "PolygonClip.h"
#include "Triangle.h"
#include "Types.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <cmath>

namespace smokevis
{
namespace
{

/// Whether a polygon is convex and, to a thousandth of its size, plane.
bool PlaneAndConvex(const std::vector<Vec3>& corners)
{
  const Vec3 area = AreaVector(corners);
  const double size = glm::length(area);
  if (!(size > 0.0))
  {
    return corners.size() == 3;
  }
  const Vec3 normal = area / size;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3 first = corners[(i + 1) % count] - corners[i];
    const Vec3 second = corners[(i + 2) % count] - corners[(i + 1) % count];
    const double turn = glm::dot(glm::cross(first, second), normal);
    if (turn < -1e-9 * size ||
        std::abs(glm::dot(corners[i] - corners[0], normal)) > 1e-3 * std::sqrt(size))
    {
      return false;
    }
  }
  return true;
}

/// Takes polygons and puts out pieces.
class Refiner
{
public:
  Refiner(vtkPolyData* input, const std::string& name, double patchSize)
      : Name_(name), PatchSize_(patchSize)
  {
    const vtkIdType count = input->GetNumberOfPoints();
    this->Points_->SetDataTypeToDouble();
    this->Points_->SetNumberOfPoints(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      double point[3];
      input->GetPoint(i, point);
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
      {
        throw Error("block '" + name + "', point " + std::to_string(i),
          "a coordinate is not finite", "Repair the geometry");
      }
      this->Points_->SetPoint(i, point);
    }
  }

  void Add(const std::vector<vtkIdType>& given, vtkIdType parent)
  {
    this->Parent_ = parent;
    std::vector<vtkIdType> ids;
    for (const vtkIdType id : given)
    {
      if (ids.empty() || ids.back() != id)
      {
        ids.push_back(id);
      }
    }
    while (ids.size() > 1 && ids.back() == ids.front())
    {
      ids.pop_back();
    }
    if (ids.size() < 3)
    {
      return;
    }
    std::vector<Vec3> corners;
    double longest = 0.0;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      corners.push_back(this->Point(ids[i]));
      longest =
        std::max(longest, glm::distance(corners[i], this->Point(ids[(i + 1) % ids.size()])));
    }
    const bool convex = PlaneAndConvex(corners);
    if (convex && longest <= this->PatchSize_)
    {
      this->Put(ids.data(), ids.size());
    }
    else if (convex && ids.size() == 4)
    {
      this->CutQuad(corners);
    }
    else
    {
      std::vector<std::array<double, 3>> points;
      for (const Vec3& corner : corners)
      {
        points.push_back({corner.x, corner.y, corner.z});
      }
      for (const auto& triangle : TriangulatePolygon(points))
      {
        this->CutTriangle({ids[triangle[0]], ids[triangle[1]], ids[triangle[2]]});
      }
    }
  }

  vtkSmartPointer<vtkPolyData> Finish(vtkPolyData* input)
  {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(this->Points_);
    result->SetPolys(this->Polys_);
    result->GetFieldData()->PassData(input->GetFieldData());
    vtkCellData* const cells = result->GetCellData();
    cells->CopyAllocate(input->GetCellData(), this->Parents_->GetNumberOfValues());
    for (vtkIdType i = 0; i < this->Parents_->GetNumberOfValues(); ++i)
    {
      cells->CopyData(input->GetCellData(), this->Parents_->GetValue(i), i);
    }
    this->Parents_->SetName("ParentCell");
    cells->AddArray(this->Parents_);
    return result;
  }

private:
  Vec3 Point(vtkIdType id) const
  {
    Vec3 point;
    this->Points_->GetPoint(id, &point.x);
    return point;
  }

  void Put(const vtkIdType* ids, std::size_t count)
  {
    this->Polys_->InsertNextCell(static_cast<vtkIdType>(count), ids);
    this->Parents_->InsertNextValue(this->Parent_);
  }

  void CheckCount(double pieces) const
  {
    if (static_cast<double>(this->Parents_->GetNumberOfValues()) + pieces > MaximumPatches)
    {
      throw Error("block '" + this->Name_ + "', cell " + std::to_string(this->Parent_),
        "the surfaces would be cut into more than " + std::to_string(MaximumPatches) + " patches",
        "Raise PatchSize");
    }
  }

  /// Bilinear lattice of quads.
  void CutQuad(const std::vector<Vec3>& corners)
  {
    const auto pieces = [&](double first, double second)
    { return std::max(1.0, std::ceil(std::max(first, second) / this->PatchSize_ * (1.0 - 1e-9))); };
    const double columns =
      pieces(glm::distance(corners[0], corners[1]), glm::distance(corners[3], corners[2]));
    const double rows =
      pieces(glm::distance(corners[0], corners[3]), glm::distance(corners[1], corners[2]));
    this->CheckCount(columns * rows);
    const auto nu = static_cast<vtkIdType>(columns);
    const auto nv = static_cast<vtkIdType>(rows);
    const vtkIdType first = this->Points_->GetNumberOfPoints();
    for (vtkIdType j = 0; j <= nv; ++j)
    {
      const double v = static_cast<double>(j) / rows;
      const Vec3 left = glm::mix(corners[0], corners[3], v);
      const Vec3 right = glm::mix(corners[1], corners[2], v);
      for (vtkIdType i = 0; i <= nu; ++i)
      {
        const Vec3 point = glm::mix(left, right, static_cast<double>(i) / columns);
        this->Points_->InsertNextPoint(&point.x);
      }
    }
    for (vtkIdType j = 0; j < nv; ++j)
    {
      for (vtkIdType i = 0; i < nu; ++i)
      {
        const vtkIdType corner = first + i + (nu + 1) * j;
        const vtkIdType ids[4] = {corner, corner + 1, corner + nu + 2, corner + nu + 1};
        this->Put(ids, 4);
      }
    }
  }

  /// Halves a triangle across its longest edge until no edge is too long.
  void CutTriangle(const std::array<vtkIdType, 3>& triangle)
  {
    std::vector<std::array<vtkIdType, 3>> open = {triangle};
    while (!open.empty())
    {
      const std::array<vtkIdType, 3> ids = open.back();
      open.pop_back();
      const Triangle corners = {this->Point(ids[0]), this->Point(ids[1]), this->Point(ids[2])};
      int edge = 0;
      double longest = 0.0;
      for (int i = 0; i < 3; ++i)
      {
        const double length = glm::distance(corners[i], corners[(i + 1) % 3]);
        if (length > longest)
        {
          longest = length;
          edge = i;
        }
      }
      if (longest <= this->PatchSize_)
      {
        this->Put(ids.data(), 3);
        continue;
      }
      this->CheckCount(static_cast<double>(open.size()) + longest / this->PatchSize_);
      const Vec3 middle = 0.5 * (corners[edge] + corners[(edge + 1) % 3]);
      const vtkIdType id = this->Points_->InsertNextPoint(&middle.x);
      open.push_back({id, ids[(edge + 1) % 3], ids[(edge + 2) % 3]});
      open.push_back({ids[edge], id, ids[(edge + 2) % 3]});
    }
  }

  std::string Name_;
  double PatchSize_;
  vtkIdType Parent_ = 0;
  vtkNew<vtkPoints> Points_;
  vtkNew<vtkCellArray> Polys_;
  vtkNew<vtkIdTypeArray> Parents_;
};

} // namespace

//------------------------------------------------------------------------------
std::vector<std::array<int, 3>> TriangulatePolygon(const std::vector<std::array<double, 3>>& points)
{
  const auto count = static_cast<int>(points.size());
  std::vector<std::array<int, 3>> triangles;
  std::vector<Vec3> corners;
  for (const auto& point : points)
  {
    corners.emplace_back(point[0], point[1], point[2]);
  }
  if (count > 3 && !PlaneAndConvex(corners))
  {
    vtkNew<vtkPolygon> polygon;
    polygon->GetPointIds()->SetNumberOfIds(count);
    polygon->GetPoints()->SetDataTypeToDouble();
    polygon->GetPoints()->SetNumberOfPoints(count);
    for (int i = 0; i < count; ++i)
    {
      polygon->GetPointIds()->SetId(i, i);
      const Vec3 local = corners[i] - corners[0];
      polygon->GetPoints()->SetPoint(i, &local.x);
    }
    vtkNew<vtkIdList> ids;
    if (polygon->EarCutTriangulation(ids) != 0)
    {
      for (vtkIdType i = 0; i + 2 < ids->GetNumberOfIds(); i += 3)
      {
        triangles.push_back({static_cast<int>(ids->GetId(i)), static_cast<int>(ids->GetId(i + 1)),
          static_cast<int>(ids->GetId(i + 2))});
      }
      return triangles;
    }
  }
  for (int i = 1; i + 1 < count; ++i)
  {
    triangles.push_back({0, i, i + 1});
  }
  return triangles;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> RefineSurface(
  vtkPolyData* input, const std::string& name, double patchSize)
{
  vtkSmartPointer<vtkPolyData> source = input;
  if (input->GetNumberOfStrips() > 0)
  {
    auto copy = vtkSmartPointer<vtkPolyData>::New();
    copy->ShallowCopy(input);
    vtkNew<vtkTriangleFilter> strips;
    strips->SetInputData(copy);
    strips->PassVertsOff();
    strips->PassLinesOff();
    strips->Update();
    source = strips->GetOutput();
  }
  Refiner refiner(source, name, patchSize);
  // Cell data count points and lines before polygons.
  vtkIdType cell = source->GetNumberOfVerts() + source->GetNumberOfLines();
  const auto iterator = vtk::TakeSmartPointer(source->GetPolys()->NewIterator());
  std::vector<vtkIdType> ids;
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    if (!HiddenCell(*source, cell))
    {
      vtkIdType count;
      const vtkIdType* corners;
      iterator->GetCurrentCell(count, corners);
      ids.assign(corners, corners + count);
      refiner.Add(ids, cell);
    }
    ++cell;
  }
  return refiner.Finish(source);
}

} // namespace smokevis
