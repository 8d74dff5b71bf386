// What filters keep from one time step, or one map, to the next.
#include "SkipComparison.h"

#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkExitSignSource.h>
#include <vtkFloatArray.h>
#include <vtkFloorMapOfVisibility.h>
#include <vtkImageData.h>
#include <vtkLuminaireSource.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkSmokeLightField.h>

namespace smokevis::benchmark
{

namespace
{

constexpr double Length = 60.0;
constexpr double Width = 4.0;
constexpr double Height = 3.0;
constexpr double CellSize = 0.5;

Values ValuesOf(vtkDataArray* array)
{
  Values values;
  for (vtkIdType tuple = 0; tuple < array->GetNumberOfTuples(); ++tuple)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      values.push_back(array->GetComponent(tuple, component));
    }
  }
  return values;
}

/// A corridor with smoke that is thickest under the ceiling, a lamp and a sign at its end.
class Corridor
{
public:
  Corridor()
  {
    this->Smoke_->SetSpacing(CellSize, CellSize, CellSize);
    this->Smoke_->SetDimensions(static_cast<int>(Length / CellSize) + 1,
      static_cast<int>(Width / CellSize) + 1, static_cast<int>(Height / CellSize) + 1);
    this->Walls_->SetBounds(0.0, Length, 0.0, Width, 0.0, Height);
    this->Sign_->SetCenter(Length - 0.01, 0.5 * Width, 2.2);
    this->Sign_->SetNormal(-1.0, 0.0, 0.0);
    this->Lamp_->SetCenter(0.5 * Length, 0.5 * Width, Height - 0.01);
    this->Lamp_->SetNormal(0.0, 0.0, -1.0);
  }

  void Connect(vtkSmokeLightField& field)
  {
    field.SetInputDataObject(0, this->Smoke_);
    field.AddInputConnection(1, this->Walls_->GetOutputPort());
    field.AddInputConnection(2, this->Sign_->GetOutputPort());
    field.AddInputConnection(2, this->Lamp_->GetOutputPort());
    field.SetTolerance(0.1);
  }

  /// As a reader does at each time step: other objects, with the same content.
  void Step()
  {
    vtkNew<vtkFloatArray> extinction;
    extinction->SetName("Extinction");
    const vtkIdType cells = this->Smoke_->GetNumberOfCells();
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      extinction->InsertNextValue(0.1F + 0.3F * static_cast<float>(cell) / cells);
    }
    this->Smoke_->GetCellData()->AddArray(extinction);
    this->Smoke_->Modified();
    this->Walls_->Modified();
    this->Sign_->Modified();
    this->Lamp_->Modified();
  }

private:
  vtkNew<vtkImageData> Smoke_;
  vtkNew<vtkCubeSource> Walls_;
  vtkNew<vtkExitSignSource> Sign_;
  vtkNew<vtkLuminaireSource> Lamp_;
};

Values FluenceOf(vtkSmokeLightField& field)
{
  field.Update();
  return ValuesOf(vtkDataSet::SafeDownCast(field.GetOutput()->GetPartitionAsDataObject(0, 0))
                    ->GetCellData()
                    ->GetArray("Fluence"));
}

} // namespace

//--------------------------------------------------------------------------------------------------
void CompareSteps(ResultTable& table)
{
  Corridor corridor;
  corridor.Step();
  vtkNew<vtkSmokeLightField> field;
  corridor.Connect(*field);
  field->Update();
  Compare(table, "light field of an unchanged time step", "corridor of 60 m in the filter",
    [&](bool skips)
    {
      corridor.Step();
      if (skips)
      {
        return FluenceOf(*field);
      }
      vtkNew<vtkSmokeLightField> fresh;
      corridor.Connect(*fresh);
      return FluenceOf(*fresh);
    });
  const auto connect = [&field](vtkFloorMapOfVisibility& map)
  {
    map.SetInputConnection(field->GetOutputPort());
    map.SetResolution(12, 2);
  };
  vtkNew<vtkFloorMapOfVisibility> kept;
  connect(*kept);
  kept->Update();
  Compare(table, "what views have prepared of an unchanged light field", "the same: map of 12 x 2",
    [&](bool skips)
    {
      vtkNew<vtkFloorMapOfVisibility> fresh;
      connect(*fresh);
      vtkFloorMapOfVisibility& map = skips ? *kept : *fresh;
      map.Modified();
      map.Update();
      return ValuesOf(map.GetOutput()->GetPointData()->GetArray("Visibility"));
    });
}

} // namespace smokevis::benchmark
