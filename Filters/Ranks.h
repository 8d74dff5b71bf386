// The processes of a parallel run that execute one pipeline together.
#pragma once

#include "Errors.h"

#include <vtkAlgorithm.h>
#include <vtkCommunicator.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <utility>
#include <vector>

namespace smokevis
{

/// What each process of a parallel run (mpiexec pvbatch, pvserver) does for the others. All of them
/// execute the same algorithms in the same order, and must call the same functions of this class.
/// On its own a process is rank 0 of 1, and nothing is sent.
class Ranks
{
public:
  Ranks() : Controller_(vtkMultiProcessController::GetGlobalController())
  {
    if (this->Controller_)
    {
      this->Count_ = std::max(1, this->Controller_->GetNumberOfProcesses());
      this->Rank_ = this->Controller_->GetLocalProcessId();
    }
  }

  int Rank() const { return this->Rank_; }
  int Count() const { return this->Count_; }

  /// The items [first, second) of so many that a process works on: in turn, as evenly as can be.
  std::pair<std::size_t, std::size_t> Share(std::size_t items, int rank) const
  {
    return {items * rank / this->Count_, items * (rank + 1) / this->Count_};
  }
  std::pair<std::size_t, std::size_t> Share(std::size_t items) const
  {
    return this->Share(items, this->Rank_);
  }

  /// Does a piece of work that may throw. When it fails, or is aborted, for one process it throws
  /// for all of them, so that none waits for another for ever.
  void Together(vtkAlgorithm* algorithm, const std::function<void()>& work) const
  {
    std::exception_ptr problem;
    try
    {
      work();
    }
    catch (...)
    {
      problem = std::current_exception();
    }
    const int aborted = this->Most(problem && algorithm->GetAbortOutput() ? 1 : 0);
    const int failed = this->Most(problem && !algorithm->GetAbortOutput() ? 1 : 0);
    if (problem)
    {
      std::rethrow_exception(problem);
    }
    if (failed > 0 || aborted > 0)
    {
      algorithm->SetAbortOutput(failed == 0);
      throw Error("parallel run", "another process could not do its part", "Its message says why");
    }
  }

  /// The largest of a number over all processes.
  int Most(int own) const
  {
    int most = own;
    if (this->Count_ > 1)
    {
      this->Controller_->AllReduce(&own, &most, 1, vtkCommunicator::MAX_OP);
    }
    return most;
  }

  double Sum(double own) const
  {
    double sum = own;
    if (this->Count_ > 1)
    {
      this->Controller_->AllReduce(&own, &sum, 1, vtkCommunicator::SUM_OP);
    }
    return sum;
  }

  /// Which of some numbers are the same in all processes.
  std::vector<bool> Alike(const std::vector<std::uint64_t>& own) const
  {
    std::vector<bool> alike(own.size(), true);
    if (this->Count_ > 1 && !own.empty())
    {
      const std::vector<vtkTypeUInt64> send(own.begin(), own.end());
      std::vector<vtkTypeUInt64> all(own.size() * this->Count_);
      this->Controller_->AllGather(send.data(), all.data(), static_cast<vtkIdType>(own.size()));
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        const std::size_t number = i % own.size();
        alike[number] = alike[number] && all[i] == all[number];
      }
    }
    return alike;
  }

  /// A number of each process, by rank.
  std::vector<double> Each(double own) const
  {
    std::vector<double> all(this->Count_, own);
    if (this->Count_ > 1)
    {
      this->Controller_->AllGather(&own, all.data(), 1);
    }
    return all;
  }

  /// Completes values, so many an item, of which each process has those of its Share.
  template <class Value> void Complete(std::vector<Value>& values, std::size_t items) const
  {
    if (this->Count_ == 1 || items == 0)
    {
      return;
    }
    const std::size_t bytes = values.size() / items * sizeof(Value);
    std::vector<vtkIdType> lengths;
    std::vector<vtkIdType> offsets;
    for (int rank = 0; rank < this->Count_; ++rank)
    {
      const auto [first, end] = this->Share(items, rank);
      offsets.push_back(static_cast<vtkIdType>(first * bytes));
      lengths.push_back(static_cast<vtkIdType>((end - first) * bytes));
    }
    auto* const all = reinterpret_cast<char*>(values.data());
    const std::vector<char> own(
      all + offsets[this->Rank_], all + offsets[this->Rank_] + lengths[this->Rank_]);
    this->Controller_->AllGatherV(
      own.data(), all, lengths[this->Rank_], lengths.data(), offsets.data());
  }

private:
  vtkMultiProcessController* Controller_;
  int Rank_ = 0;
  int Count_ = 1;
};

/// Which piece of an output is asked for, and of how many.
inline std::pair<int, int> AskedPiece(vtkInformation* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int pieces = output->Has(Pipeline::UPDATE_NUMBER_OF_PIECES())
                       ? std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()))
                       : 1;
  return {pieces > 1 ? output->Get(Pipeline::UPDATE_PIECE_NUMBER()) : 0, pieces};
}

/// For RequestInformation: this algorithm executes on every process, whichever piece it is asked.
inline void HandlePieces(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
}

/// Empties outputs that are not divided unless the first piece is asked for: what all processes
/// have is shown and saved once.
inline void LeaveToFirstPiece(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* const info = outputs->GetInformationObject(port);
    if (AskedPiece(info).first > 0)
    {
      info->Get(vtkDataObject::DATA_OBJECT())->Initialize();
    }
  }
}

} // namespace smokevis
