// Smoke that is the same everywhere, for the tests of pipelines.
#pragma once

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>

/// Gives all cells of an image one extinction [1/m].
inline void FillExtinction(vtkImageData* smoke, double value)
{
  vtkNew<vtkDoubleArray> extinction;
  extinction->SetName("Extinction");
  extinction->SetNumberOfTuples(smoke->GetNumberOfCells());
  extinction->Fill(value);
  smoke->GetCellData()->AddArray(extinction);
  smoke->Modified();
}
