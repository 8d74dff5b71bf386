// What each process of a parallel run did, as rows of the work report.
#pragma once

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <string>
#include <vector>

namespace smokevis
{

/// A number of each process, by rank, and what is to be said about it.
struct RankNumbers
{
  const char* What = "";
  std::vector<double> Of;
  const char* Why = "";
};

/// An array of field data, made where there is none.
template <class Array> Array& FieldArray(vtkFieldData& fields, const char* name)
{
  if (!Array::SafeDownCast(fields.GetAbstractArray(name)))
  {
    vtkNew<Array> array;
    array->SetName(name);
    fields.AddArray(array);
  }
  return *Array::SafeDownCast(fields.GetAbstractArray(name));
}

/// Adds a row for each number and process, such as "seconds of process 0", to the arrays
/// WorkReportWhat, WorkReportCount and WorkReportWhy.
inline void ReportRanks(vtkFieldData& fields, const std::vector<RankNumbers>& numbers)
{
  auto& what = FieldArray<vtkStringArray>(fields, "WorkReportWhat");
  auto& count = FieldArray<vtkDoubleArray>(fields, "WorkReportCount");
  auto& why = FieldArray<vtkStringArray>(fields, "WorkReportWhy");
  for (const RankNumbers& number : numbers)
  {
    for (std::size_t rank = 0; rank < number.Of.size(); ++rank)
    {
      what.InsertNextValue(std::string(number.What) + " of process " + std::to_string(rank));
      count.InsertNextValue(number.Of[rank]);
      why.InsertNextValue(number.Why);
    }
  }
}

} // namespace smokevis
