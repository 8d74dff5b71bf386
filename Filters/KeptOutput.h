// Keeps the last whole output of an algorithm, to show it again where new work is given up.
#pragma once

#include "Errors.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkSmartPointer.h>
#include <vtkTimeStamp.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <vector>

namespace smokevis
{

/// Thrown where a filter upstream was aborted, and put out what it had before.
class StoppedUpstream : public Error
{
public:
  using Error::Error;
};

/// VTK empties the outputs of an algorithm before it works and after it was aborted. Whoever stops
/// work that takes long wants the former picture back instead.
class KeptOutput
{
public:
  /// For RequestData: does the work that fills the outputs, keeps them and returns 1. Where the
  /// work was stopped, here or upstream, what was kept comes back. Any other error is reported,
  /// once, and leaves the outputs empty; then 0 is returned.
  /// @param wanted the port that the work fills; the others stay as they are. -1: all.
  int Produce(vtkAlgorithm* algorithm, vtkInformationVector* outputs,
    const std::function<void()>& work, int wanted = -1)
  {
    const int first = std::max(wanted, 0);
    const int end = wanted < 0 ? outputs->GetNumberOfInformationObjects() : wanted + 1;
    const auto restore = [&]
    {
      for (int port = first; port < end; ++port)
      {
        this->Restore(algorithm, outputs, port);
      }
      return 1;
    };
    try
    {
      work();
      for (int port = first; port < end; ++port)
      {
        this->Keep(outputs, port);
      }
      return 1;
    }
    catch (const StoppedUpstream&)
    {
      return restore();
    }
    catch (const std::exception& error)
    {
      if (algorithm->GetAbortOutput())
      {
        return restore();
      }
      this->Clear();
      for (int port = first; port < end; ++port)
      {
        vtkDataObject::GetData(outputs, port)->Initialize();
      }
      vtkErrorWithObjectMacro(algorithm, << error.what());
      return 0;
    }
  }

  bool Has(int port) const
  {
    return static_cast<std::size_t>(port) < this->Outputs_.size() && this->Outputs_[port];
  }

  /// Hands out once more what was kept.
  void Show(vtkInformationVector* outputs, int port) const
  {
    Copy(this->Outputs_[port], vtkDataObject::GetData(outputs, port));
  }

  /// Forgets everything, after an error.
  void Clear()
  {
    this->Outputs_.clear();
    this->IsDue_ = false;
  }

  /// For the algorithm's ComputePipelineMTime: later than its outputs where they are not those that
  /// it was asked for.
  vtkMTimeType PipelineMTime(vtkMTimeType own)
  {
    if (this->IsDue_)
    {
      this->Due_.Modified();
      return std::max(own, this->Due_.GetMTime());
    }
    return own;
  }

private:
  /// Notes an output that is whole. Arrays are shared, not copied.
  void Keep(vtkInformationVector* outputs, int port)
  {
    vtkDataObject* const output = vtkDataObject::GetData(outputs, port);
    this->Outputs_.resize(outputs->GetNumberOfInformationObjects());
    this->Outputs_[port].TakeReference(output->NewInstance());
    Copy(output, this->Outputs_[port]);
    this->IsDue_ = false;
  }

  /// Brings back what was kept for the port after an abort, and has the algorithm work again when
  /// it is updated next. Where nothing was kept the output is empty, as VTK has it.
  void Restore(vtkAlgorithm* algorithm, vtkInformationVector* outputs, int port)
  {
    vtkDataObject* const output = vtkDataObject::GetData(outputs, port);
    output->Initialize();
    if (this->Has(port))
    {
      this->Show(outputs, port);
      // Else the executive empties the output, and those of all algorithms downstream.
      algorithm->SetAbortOutput(false);
      this->IsDue_ = true;
    }
  }

  static void Copy(vtkDataObject* from, vtkDataObject* to)
  {
    to->ShallowCopy(from);
    vtkInformation* const info = from->GetInformation();
    if (info->Has(vtkDataObject::DATA_TIME_STEP()))
    {
      to->GetInformation()->Set(
        vtkDataObject::DATA_TIME_STEP(), info->Get(vtkDataObject::DATA_TIME_STEP()));
    }
  }

  std::vector<vtkSmartPointer<vtkDataObject>> Outputs_;
  bool IsDue_ = false;
  vtkTimeStamp Due_;
};

} // namespace smokevis
