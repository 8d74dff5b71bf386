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

/// Adds two rows a process, "seconds of process 0" and "bytes of process 0", to the arrays
/// WorkReportWhat, WorkReportCount and WorkReportWhy.
inline void ReportRanks(vtkFieldData& fields, const RankNumbers& seconds, const RankNumbers& bytes)
{
  auto& what = FieldArray<vtkStringArray>(fields, "WorkReportWhat");
  auto& count = FieldArray<vtkDoubleArray>(fields, "WorkReportCount");
  auto& why = FieldArray<vtkStringArray>(fields, "WorkReportWhy");
  for (std::size_t rank = 0; rank < seconds.Of.size(); ++rank)
  {
    const std::string process = " of process " + std::to_string(rank);
    what.InsertNextValue("seconds" + process);
    count.InsertNextValue(seconds.Of[rank]);
    why.InsertNextValue(seconds.Why);
    what.InsertNextValue("bytes" + process);
    count.InsertNextValue(bytes.Of[rank]);
    why.InsertNextValue(bytes.Why);
  }
}

} // namespace smokevis
