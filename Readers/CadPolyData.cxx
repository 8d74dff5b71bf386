// Builds VTK data of a CAD model.
#include "CadPolyData.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace smokevis
{
namespace
{

const char* SourceName(CadSource source)
{
  switch (source)
  {
  case CadSource::File:
    return "stated by the file";
  case CadSource::User:
    return "the property";
  default:
    return "the format's default";
  }
}

void AddField(vtkFieldData& fields, const char* name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& value : values)
  {
    array->InsertNextValue(value);
  }
  fields.AddArray(array);
}

void AddField(vtkFieldData& fields, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  fields.AddArray(array);
}

/// Triangles of one output, with their arrays.
class Part
{
public:
  Part(const CadModel& model, const vtkMatrix4x4& placement, bool emits, bool coloredLight)
      : Model_(model), Placement_(placement), Emits_(emits), PointOf_(model.Points.size(), -1)
  {
    this->Points_->SetDataTypeToDouble();
    this->Reflectance_->SetName("Reflectance");
    this->Reflectance_->SetNumberOfComponents(3);
    this->Material_->SetName("Material");
    this->Object_->SetName("Object");
    this->MaterialId_->SetName("MaterialId");
    this->ObjectId_->SetName("ObjectId");
    this->Luminance_->SetName("Luminance");
    this->Luminance_->SetNumberOfComponents(coloredLight ? 3 : 1);
    this->SignId_->SetName("SignId");
    this->SignName_->SetName("SignName");
  }

  void Add(const CadTriangle& triangle, const std::array<float, 3>& reflectance,
    const CadTreatment& treatment)
  {
    this->Triangles_->InsertNextCell(3);
    for (const std::uint32_t corner : triangle.Corners)
    {
      this->Triangles_->InsertCellPoint(this->PointId(corner));
    }
    this->Reflectance_->InsertNextTypedTuple(reflectance.data());
    this->Material_->InsertNextValue(this->Model_.Materials[triangle.Material].Name);
    this->Object_->InsertNextValue(this->Model_.Objects[triangle.Object].Name);
    this->MaterialId_->InsertNextValue(triangle.Material);
    this->ObjectId_->InsertNextValue(triangle.Object);
    if (this->Emits_)
    {
      for (int i = 0; i < this->Luminance_->GetNumberOfComponents(); ++i)
      {
        const std::vector<double>& light = treatment.Luminance;
        this->Luminance_->InsertNextValue(
          light.empty() ? 0.0 : light[light.size() == 3 ? static_cast<std::size_t>(i) : 0]);
      }
      const int id = treatment.SignId.value_or(-1);
      this->SignId_->InsertNextValue(id);
      this->SignName_->InsertNextValue(!treatment.SignName.empty() ? treatment.SignName
                                       : id < 0                    ? "Lamp"
                                                                   : "Sign " + std::to_string(id));
    }
  }

  void Finish(vtkPolyData& output) const
  {
    output.Initialize();
    output.SetPoints(this->Points_);
    output.SetPolys(this->Triangles_);
    vtkCellData* const cells = output.GetCellData();
    cells->AddArray(this->Reflectance_);
    cells->AddArray(this->Material_);
    cells->AddArray(this->Object_);
    cells->AddArray(this->MaterialId_);
    cells->AddArray(this->ObjectId_);
    if (this->Emits_)
    {
      cells->AddArray(this->Luminance_);
      cells->AddArray(this->SignId_);
      cells->AddArray(this->SignName_);
    }
  }

private:
  vtkIdType PointId(std::uint32_t corner)
  {
    vtkIdType& id = this->PointOf_[corner];
    if (id < 0)
    {
      const CadPoint& from = this->Model_.Points[corner];
      double to[3];
      for (int i = 0; i < 3; ++i)
      {
        to[i] = this->Placement_.GetElement(i, 3);
        for (int j = 0; j < 3; ++j)
        {
          to[i] += this->Placement_.GetElement(i, j) * from[j];
        }
      }
      id = this->Points_->InsertNextPoint(to);
    }
    return id;
  }

  const CadModel& Model_;
  const vtkMatrix4x4& Placement_;
  bool Emits_;
  std::vector<vtkIdType> PointOf_;
  vtkNew<vtkPoints> Points_;
  vtkNew<vtkCellArray> Triangles_;
  vtkNew<vtkFloatArray> Reflectance_;
  vtkNew<vtkStringArray> Material_;
  vtkNew<vtkStringArray> Object_;
  vtkNew<vtkIntArray> MaterialId_;
  vtkNew<vtkIntArray> ObjectId_;
  vtkNew<vtkDoubleArray> Luminance_;
  vtkNew<vtkIntArray> SignId_;
  vtkNew<vtkStringArray> SignName_;
};

std::array<float, 3> ReflectanceOf(const CadTriangle& triangle, const CadMaterial& material,
  const CadTreatment& treatment, double otherwise)
{
  std::array<float, 3> result = triangle.Reflectance;
  const std::vector<double>& given = treatment.Reflectance;
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    if (!given.empty())
    {
      result[i] = static_cast<float>(given[given.size() == 3 ? i : 0]);
    }
    else if (result[i] < 0.0F)
    {
      result[i] = static_cast<float>(material.Reflectance ? (*material.Reflectance)[i] : otherwise);
    }
  }
  return result;
}

void AddReport(const CadModel& model, const CadTriangleCounts& counts, vtkPolyData& surfaces,
  vtkPolyData& emitters)
{
  vtkBoundingBox box;
  for (vtkPolyData* const part : {&surfaces, &emitters})
  {
    if (part->GetNumberOfPoints() > 0)
    {
      box.AddBounds(part->GetBounds());
    }
  }
  std::vector<double> bounds(6, 0.0);
  if (box.IsValid())
  {
    box.GetBounds(bounds.data());
  }
  std::vector<std::string> materials, objects, groups;
  for (const CadMaterial& material : model.Materials)
  {
    materials.push_back(material.Name);
  }
  for (const CadObject& object : model.Objects)
  {
    objects.push_back(object.Name);
    std::string path;
    for (const std::string& group : object.Groups)
    {
      path += (path.empty() ? "" : "/") + group;
    }
    groups.push_back(path);
  }
  vtkNew<vtkFieldData> fields;
  AddField(*fields, "Format", std::vector<std::string>{model.Format});
  AddField(*fields, "UnitScale", std::vector<double>{model.UnitScale});
  AddField(*fields, "UnitSource", std::vector<std::string>{SourceName(model.UnitSource)});
  AddField(*fields, "UpAxis",
    std::vector<std::string>{std::string(1, " xyz"[static_cast<int>(model.Up)])});
  AddField(*fields, "UpSource", std::vector<std::string>{SourceName(model.UpSource)});
  AddField(*fields, "ModelBounds", bounds);
  AddField(*fields, "Triangles", std::vector<double>{static_cast<double>(counts.Kept)});
  AddField(*fields, "DegenerateTriangles",
    std::vector<double>{static_cast<double>(model.DegenerateTriangles)});
  AddField(
    *fields, "TransparentTriangles", std::vector<double>{static_cast<double>(counts.Transparent)});
  AddField(*fields, "DroppedTriangles", std::vector<double>{static_cast<double>(counts.Dropped)});
  AddField(*fields, "MaterialNames", materials);
  AddField(*fields, "ObjectNames", objects);
  AddField(*fields, "ObjectGroups", groups);
  surfaces.GetFieldData()->ShallowCopy(fields);
  emitters.GetFieldData()->ShallowCopy(fields);
}

} // namespace

//------------------------------------------------------------------------------------------------
CadTriangleCounts BuildCadPolyData(const CadModel& model, const MaterialTable& table,
  const CadPolyDataOptions& options, const vtkMatrix4x4& placement, vtkPolyData& surfaces,
  vtkPolyData& emitters)
{
  // Few materials meet few objects; each pair is looked up once.
  std::map<std::pair<int, int>, CadTreatment> treatments;
  bool coloredLight = false;
  for (const CadTriangle& triangle : model.Triangles)
  {
    const auto [found, added] =
      treatments.try_emplace({triangle.Material, triangle.Object}, CadTreatment());
    if (added)
    {
      found->second =
        table.Find(model.Materials[triangle.Material], model.Objects[triangle.Object]);
      coloredLight = coloredLight || found->second.Luminance.size() == 3;
    }
  }
  Part walls(model, placement, false, false);
  Part lights(model, placement, true, coloredLight);
  CadTriangleCounts counts;
  for (const CadTriangle& triangle : model.Triangles)
  {
    const CadMaterial& material = model.Materials[triangle.Material];
    const CadTreatment& treatment = treatments.at({triangle.Material, triangle.Object});
    if (treatment.Drop.value_or(false))
    {
      ++counts.Dropped;
    }
    else if (material.Opacity < options.TransparencyThreshold && !treatment.Drop &&
             !treatment.IsEmitter())
    {
      ++counts.Transparent;
    }
    else
    {
      ++counts.Kept;
      (treatment.IsEmitter() ? lights : walls)
        .Add(triangle, ReflectanceOf(triangle, material, treatment, options.DefaultReflectance),
          treatment);
    }
  }
  walls.Finish(surfaces);
  lights.Finish(emitters);
  AddReport(model, counts, surfaces, emitters);
  return counts;
}

} // namespace smokevis
