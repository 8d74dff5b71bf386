// Lists and sums up what data objects hold.
#include "Identity.h"

#include "SceneBlocks.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>

#include <functional>
#include <string_view>

namespace smokevis
{
namespace
{

/// What was done to make data, and how long it took, is not part of them.
bool IsReport(vtkAbstractArray* array)
{
  return array && array->GetName() &&
         std::string_view(array->GetName()).substr(0, 10) == "WorkReport";
}

/// Calls a function with every array of a data object: attributes, field data, points, coordinates
/// and cells.
template <class Visit> void VisitArrays(vtkDataObject* data, Visit&& visit)
{
  const auto fields = [&visit](vtkFieldData* arrays)
  {
    for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
    {
      if (!IsReport(arrays->GetAbstractArray(i)))
      {
        visit(arrays->GetAbstractArray(i));
      }
    }
  };
  fields(data->GetFieldData());
  if (auto* const set = vtkDataSet::SafeDownCast(data))
  {
    fields(set->GetCellData());
    fields(set->GetPointData());
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    visit(grid->GetXCoordinates());
    visit(grid->GetYCoordinates());
    visit(grid->GetZCoordinates());
  }
  auto* const points = vtkPointSet::SafeDownCast(data);
  if (points && points->GetPoints())
  {
    visit(points->GetPoints()->GetData());
  }
  const auto cells = [&visit](vtkCellArray* of)
  {
    if (of && of->GetNumberOfCells() > 0)
    {
      visit(of->GetOffsetsArray());
      visit(of->GetConnectivityArray());
    }
  };
  if (auto* const mesh = vtkPolyData::SafeDownCast(data))
  {
    for (vtkCellArray* const kind :
      {mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips()})
    {
      cells(kind);
    }
  }
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    cells(grid->GetCells());
    visit(grid->GetCellTypesArray());
  }
}

/// A sum over bytes that depends on their order.
class Sum
{
public:
  void Add(std::string_view bytes)
  {
    // The shift and the odd constant spread what was added before (boost::hash_combine).
    this->Value_ ^= std::hash<std::string_view>()(bytes) + 0x9e3779b97f4a7c15ULL +
                    (this->Value_ << 6U) + (this->Value_ >> 2U);
  }
  template <class Value> void AddValue(const Value& value)
  {
    this->Add({reinterpret_cast<const char*>(&value), sizeof(value)});
  }
  void Add(vtkAbstractArray* array)
  {
    this->AddValue(array->GetNumberOfComponents());
    this->Add(array->GetName() ? array->GetName() : "");
    if (auto* const texts = vtkStringArray::SafeDownCast(array))
    {
      for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
      {
        this->Add(texts->GetValue(i));
      }
    }
    else if (array->HasStandardMemoryLayout())
    {
      this->Add({static_cast<const char*>(array->GetVoidPointer(0)),
        static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize()});
    }
    else if (auto* const numbers = vtkDataArray::SafeDownCast(array))
    {
      for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
      {
        const int width = numbers->GetNumberOfComponents();
        this->AddValue(numbers->GetComponent(i / width, static_cast<int>(i % width)));
      }
    }
  }
  std::uint64_t Value() const { return this->Value_; }

private:
  std::uint64_t Value_ = 0;
};

void List(vtkDataObject* data, Identity& list)
{
  const std::vector<Child> children = Children(data);
  if (children.empty() && data->IsA("vtkDataSet"))
  {
    // What is not in arrays, such as the spacing of an image: VTK's own stamp.
    list.emplace_back(nullptr, vtkImageData::SafeDownCast(data) ? data->GetMTime() : 0);
  }
  VisitArrays(data,
    [&list](vtkAbstractArray* array) { list.emplace_back(array, array ? array->GetMTime() : 0); });
  for (const Child& child : children)
  {
    list.emplace_back(nullptr, 0);
    if (child.Object)
    {
      List(child.Object, list);
    }
  }
}

void AddTo(Sum& sum, vtkDataObject* data)
{
  sum.AddValue(data->GetDataObjectType());
  if (data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()))
  {
    sum.AddValue(data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()));
  }
  if (auto* const image = vtkImageData::SafeDownCast(data))
  {
    for (int i = 0; i < 6; ++i)
    {
      sum.AddValue(image->GetExtent()[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      sum.AddValue(image->GetOrigin()[i]);
      sum.AddValue(image->GetSpacing()[i]);
    }
    for (int i = 0; i < 9; ++i)
    {
      sum.AddValue(image->GetDirectionMatrix()->GetData()[i]);
    }
  }
  if (auto* const grid = vtkStructuredGrid::SafeDownCast(data))
  {
    for (int i = 0; i < 6; ++i)
    {
      sum.AddValue(grid->GetExtent()[i]);
    }
  }
  VisitArrays(data,
    [&sum](vtkAbstractArray* array)
    {
      if (array)
      {
        sum.Add(array);
      }
    });
  for (const Child& child : Children(data))
  {
    sum.Add(child.Name ? child.Name : "");
    if (child.Object)
    {
      AddTo(sum, child.Object);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
Identity IdentityOf(vtkDataObject* data)
{
  Identity list;
  if (data)
  {
    List(data, list);
  }
  return list;
}

//------------------------------------------------------------------------------
std::uint64_t Fingerprint(vtkDataObject* data)
{
  Sum sum;
  if (data)
  {
    AddTo(sum, data);
  }
  return sum.Value();
}

//------------------------------------------------------------------------------
std::uint64_t Fingerprint(vtkInformationVector* port)
{
  Sum sum;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    sum.AddValue(Fingerprint(vtkDataObject::GetData(port, i)));
  }
  return sum.Value();
}

} // namespace smokevis
