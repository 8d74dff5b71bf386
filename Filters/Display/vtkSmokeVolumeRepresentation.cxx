#include "vtkSmokeVolumeRepresentation.h"

#include "DrawnMeshes.h"
#include "SmokeImage.h"

#include <vtkActor.h>
#include <vtkAlgorithmOutput.h>
#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkOutlineSource.h>
#include <vtkPVRenderView.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartVolumeMapper.h>
#include <vtkTimeStamp.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace
{

using smokevis::DrawnMesh;
using smokevis::Lattice;

constexpr const char* ExtinctionName = "Extinction";
// Ports of the view: what is brought to where it is drawn.
constexpr int ImagePort = 0;
constexpr int OutlinePort = 1;

// The twelve edges of each mesh, in double precision: runs lie in the coordinates of a city.
void MakeOutline(const std::vector<DrawnMesh>& meshes, vtkPolyData* outline)
{
  vtkNew<vtkAppendPolyData> all;
  all->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const DrawnMesh& mesh : meshes)
  {
    vtkNew<vtkOutlineSource> box;
    box->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    box->SetBounds(mesh.Nodes[0].front(), mesh.Nodes[0].back(), mesh.Nodes[1].front(),
      mesh.Nodes[1].back(), mesh.Nodes[2].front(), mesh.Nodes[2].back());
    all->AddInputConnection(box->GetOutputPort());
  }
  if (!meshes.empty())
  {
    all->Update();
  }
  outline->ShallowCopy(all->GetOutput());
}

// Opacity 1 - exp(-K length) of smoke with K in a range. VTK makes a table of as many entries over
// the same range and reads it half an entry too low, clear smoke from the first one.
void MakeOpacity(const double range[2], double length, vtkPiecewiseFunction* opacity)
{
  constexpr int entries = 4096;
  std::vector<double> table(entries);
  for (int i = 0; i < entries; ++i)
  {
    const double extinction = range[0] + (range[1] - range[0]) * (i + 0.5) / entries;
    table[i] = i == 0 && range[0] <= 0.0 ? 0.0 : -std::expm1(-extinction * length);
  }
  if (range[0] < range[1])
  {
    opacity->BuildFunctionFromTable(range[0], range[1], entries, table.data());
  }
  else
  {
    opacity->RemoveAllPoints();
    opacity->AddPoint(range[0], table[0]);
  }
}

} // namespace

struct vtkSmokeVolumeRepresentation::Internals
{
  vtkNew<vtkSmartVolumeMapper> VolumeMapper;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkActor> OutlineActor;
  vtkNew<vtkPolyDataMapper> OutlineMapper;

  /// What this process has of the smoke, and all outlines on the first of them.
  vtkSmartPointer<vtkImageData> Image = vtkSmartPointer<vtkImageData>::New();
  vtkSmartPointer<vtkPolyData> Outline = vtkSmartPointer<vtkPolyData>::New();
  /// Of the whole image. Known where there is input, but not on a client of a server.
  Lattice Whole;

  /// What is drawn, from which delivered image.
  vtkSmartPointer<vtkImageData> Delivered;
  vtkMTimeType DeliveredTime = 0;
  double Range[2] = {};
};

vtkStandardNewMacro(vtkSmokeVolumeRepresentation);

//------------------------------------------------------------------------------
vtkSmokeVolumeRepresentation::vtkSmokeVolumeRepresentation() : Parts(new Internals)
{
  Internals& parts = *this->Parts;
  parts.VolumeMapper->SetScalarModeToUseCellFieldData();
  parts.VolumeMapper->SelectScalarArray(ExtinctionName);
  this->Actor->SetMapper(parts.VolumeMapper);
  this->Actor->SetPickable(0);
  this->Property->SetInterpolationTypeToLinear();
  this->Property->ShadeOff();
  this->Property->SetColor(parts.Color);
  this->Property->SetScalarOpacity(parts.Opacity);

  parts.OutlineActor->SetMapper(parts.OutlineMapper);
  parts.OutlineActor->SetPickable(0);
  parts.OutlineActor->GetProperty()->LightingOff();
}

//------------------------------------------------------------------------------
vtkSmokeVolumeRepresentation::~vtkSmokeVolumeRepresentation() = default;

//------------------------------------------------------------------------------
int vtkSmokeVolumeRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  // Clients of a server have none.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSmokeVolumeRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // New ones, as views keep those of other times.
  Internals& parts = *this->Parts;
  parts.Image = vtkSmartPointer<vtkImageData>::New();
  parts.Outline = vtkSmartPointer<vtkPolyData>::New();
  parts.Whole = {};
  vtkMath::UninitializeBounds(this->DataBounds);
  if (inputs[0]->GetNumberOfInformationObjects() == 1)
  {
    try
    {
      this->MakeImage(vtkDataObject::GetData(inputs[0], 0));
    }
    catch (const std::exception& error)
    {
      vtkErrorMacro("Smoke cannot be drawn: " << error.what()
                                              << ". Lower MaximumNumberOfCells, or show Outline.");
      return 0;
    }
  }
  return this->Superclass::RequestData(request, inputs, outputs);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::MakeImage(vtkDataObject* input)
{
  Internals& parts = *this->Parts;
  auto* const controller = vtkMultiProcessController::GetGlobalController();
  const int processes = controller ? controller->GetNumberOfProcesses() : 1;
  const int rank = controller ? controller->GetLocalProcessId() : 0;
  const std::vector<DrawnMesh> meshes =
    smokevis::ShareMeshes(smokevis::CollectMeshes(input), controller);
  if (rank == 0)
  {
    MakeOutline(meshes, parts.Outline);
  }
  const Lattice lattice = smokevis::LatticeOver(meshes, this->MaximumNumberOfCells, processes);
  parts.Whole = lattice;
  if (lattice.Empty())
  {
    return;
  }
  const int axis = lattice.LongestAxis();
  std::array<int, 3> first = {};
  std::array<int, 3> end = lattice.Cells;
  const auto share = [&](int of)
  { return static_cast<int>(static_cast<long long>(lattice.Cells[axis]) * of / processes); };
  first[axis] = share(rank);
  end[axis] = share(rank + 1);

  const std::vector<float> values = smokevis::SampleSmoke(meshes, lattice, first, end);
  parts.Image->SetOrigin(lattice.Origin.data());
  parts.Image->SetSpacing(lattice.Spacing.data());
  parts.Image->SetExtent(first[0], end[0], first[1], end[1], first[2], end[2]);
  vtkNew<vtkFloatArray> extinction;
  extinction->SetName(ExtinctionName);
  extinction->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), extinction->GetPointer(0));
  parts.Image->GetCellData()->SetScalars(extinction);
  parts.Image->GetBounds(this->DataBounds);
}

//------------------------------------------------------------------------------
int vtkSmokeVolumeRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* requestType, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(requestType, inInfo, outInfo))
  {
    return 0;
  }
  Internals& parts = *this->Parts;
  if (requestType == vtkPVView::REQUEST_UPDATE())
  {
    vtkPVView::SetPiece(inInfo, this, parts.Image, 0, ImagePort);
    vtkPVView::SetPiece(inInfo, this, parts.Outline, 0, OutlinePort);
    vtkNew<vtkMatrix4x4> matrix;
    this->Actor->GetMatrix(matrix);
    double bounds[6];
    parts.Outline->GetBounds(bounds);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, this->DataBounds, matrix, ImagePort);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds, matrix, OutlinePort);

    // Slabs are drawn one behind the other, and so what is between them.
    outInfo->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), 1);
    vtkPVRenderView::SetOrderedCompositingConfiguration(inInfo, this,
      parts.Whole.Empty() ? 0 : vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION, nullptr, ImagePort);
    vtkPVRenderView::SetOrderedCompositingConfiguration(inInfo, this,
      vtkPVRenderView::DATA_IS_REDISTRIBUTABLE | vtkPVRenderView::USE_DATA_FOR_LOAD_BALANCING,
      nullptr, OutlinePort);
  }
  else if (requestType == vtkPVView::REQUEST_UPDATE_LOD())
  {
    // The mapper itself takes longer steps while the camera moves.
    vtkPVView::SetPieceLOD(inInfo, this, parts.Image, 0, ImagePort);
    vtkPVView::SetPieceLOD(inInfo, this, parts.Outline, 0, OutlinePort);
  }
  else if (requestType == vtkPVView::REQUEST_RENDER())
  {
    const bool coarse = inInfo->Has(vtkPVRenderView::USE_LOD());
    const auto delivered = [&](int port)
    {
      return coarse ? vtkPVView::GetDeliveredPieceLOD(inInfo, this, port)
                    : vtkPVView::GetDeliveredPiece(inInfo, this, port);
    };
    this->ShowImage(vtkImageData::SafeDownCast(delivered(ImagePort)),
      vtkPolyData::SafeDownCast(delivered(OutlinePort)));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::ShowImage(vtkImageData* image, vtkPolyData* outline)
{
  Internals& parts = *this->Parts;
  parts.OutlineMapper->SetInputDataObject(outline);
  parts.OutlineActor->SetVisibility(
    this->GetVisibility() && outline && outline->GetNumberOfCells() > 0);

  vtkDataArray* const extinction = image ? image->GetCellData()->GetArray(ExtinctionName) : nullptr;
  if (!extinction || extinction->GetNumberOfTuples() == 0)
  {
    this->Actor->SetVisibility(0);
    return;
  }
  if (parts.Delivered != image || parts.DeliveredTime != image->GetMTime())
  {
    parts.Delivered = image;
    parts.DeliveredTime = image->GetMTime();
    extinction->GetRange(parts.Range, 0);
    vtkNew<vtkImageData> placed;
    placed->ShallowCopy(image);
    if (!parts.Whole.Empty())
    {
      placed->SetOrigin(parts.Whole.Origin.data());
      placed->SetSpacing(parts.Whole.Spacing.data());
    }
    else if (outline)
    {
      // Whole images come to a client, with their place in single precision only.
      double bounds[6];
      outline->GetBounds(bounds);
      placed->SetOrigin(bounds[0], bounds[2], bounds[4]);
    }
    parts.VolumeMapper->SetInputData(placed);
  }

  const double factor = this->ExtinctionFactor;
  this->Actor->SetVisibility(this->GetVisibility() && parts.Range[1] * factor > 0.0);
  if (parts.Range[1] * factor > 0.0)
  {
    // Over a length through which the thickest smoke lets exp(-10) pass: shorter, and VTK takes
    // opacities below 1e-4 for those of a step; longer, and single precision ends.
    constexpr double depth = 10.0;
    const double length = depth / (parts.Range[1] * factor);
    MakeOpacity(parts.Range, factor * length, parts.Opacity);
    this->Property->SetScalarOpacityUnitDistance(length);
    parts.Color->RemoveAllPoints();
    for (const double at : {0.0, parts.Range[1]})
    {
      parts.Color->AddRGBPoint(at, this->SmokeColor[0], this->SmokeColor[1], this->SmokeColor[2]);
    }
  }
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetMaximumNumberOfCells(int most)
{
  const int clamped = std::clamp(most, 1000, 1000000000);
  if (this->MaximumNumberOfCells != clamped)
  {
    this->MaximumNumberOfCells = clamped;
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Parts->OutlineActor->SetVisibility(visible);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetOutlineColor(double red, double green, double blue)
{
  this->Parts->OutlineActor->GetProperty()->SetColor(red, green, blue);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetOutlineWidth(double width)
{
  this->Parts->OutlineActor->GetProperty()->SetLineWidth(static_cast<float>(width));
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetOrientation(double x, double y, double z)
{
  this->Superclass::SetOrientation(x, y, z);
  this->Parts->OutlineActor->SetOrientation(x, y, z);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetOrigin(double x, double y, double z)
{
  this->Superclass::SetOrigin(x, y, z);
  this->Parts->OutlineActor->SetOrigin(x, y, z);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetPosition(double x, double y, double z)
{
  this->Superclass::SetPosition(x, y, z);
  this->Parts->OutlineActor->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::SetScale(double x, double y, double z)
{
  this->Superclass::SetScale(x, y, z);
  this->Parts->OutlineActor->SetScale(x, y, z);
}

//------------------------------------------------------------------------------
bool vtkSmokeVolumeRepresentation::AddToView(vtkView* view)
{
  auto* const render = vtkPVRenderView::SafeDownCast(view);
  if (!render)
  {
    return false;
  }
  render->GetRenderer()->AddActor(this->Actor);
  render->GetRenderer()->AddActor(this->Parts->OutlineActor);
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkSmokeVolumeRepresentation::RemoveFromView(vtkView* view)
{
  if (auto* const render = vtkPVRenderView::SafeDownCast(view))
  {
    render->GetRenderer()->RemoveActor(this->Actor);
    render->GetRenderer()->RemoveActor(this->Parts->OutlineActor);
  }
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
void vtkSmokeVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmokeColor: " << this->SmokeColor[0] << " " << this->SmokeColor[1] << " "
     << this->SmokeColor[2] << "\n";
  os << indent << "ExtinctionFactor: " << this->ExtinctionFactor << "\n";
  os << indent << "MaximumNumberOfCells: " << this->MaximumNumberOfCells << "\n";
}
