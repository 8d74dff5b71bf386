#include "Completion.h"

#include "DiffusionBlocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis
{

namespace
{

/// Share of what was completed that may come back before all is completed by half as much.
constexpr double MostReturned = 0.5;

} // namespace

Completion::Completion(const DiffusionBlocks& blocks, std::vector<BatchState>& batches)
    : Blocks_(blocks), Completed_(blocks.Count(), 0.0)
{
  for (BatchState& batch : batches)
  {
    batch.Residual.assign(blocks.Residuals(), 0.0);
    batch.Lacking.assign(blocks.Residuals(), 0.0);
  }
}

void Completion::CompleteSums(BatchState& batch) const
{
  this->Blocks_.CompleteSums(this->Step_, batch);
}

void Completion::CompleteLatest(int sweeps, std::vector<BatchState>& batches)
{
  this->Sweeps_ += sweeps;
  DiffusionBlocks::Lack lack = this->Blocks_.LackOf(this->Sweeps_, batches);
  if (!std::isfinite(lack.Size) || !std::isfinite(lack.Error))
  {
    // It went beyond all bounds, and no smaller step brings it back.
    this->Step_ = 0.0;
    return;
  }
  this->MayLack_ = std::max(lack.Error, lack.IsClear() ? LeftShare * lack.Size : 0.0);
  if (!lack.IsClear())
  {
    return;
  }
  const auto product = [this](const std::vector<double>& other)
  {
    return std::inner_product(this->Completed_.begin(), this->Completed_.end(), other.begin(), 0.0);
  };
  // What comes back with the other sign was completed by too much.
  if (product(lack.Fluence) < -MostReturned * product(this->Completed_))
  {
    this->Step_ *= 0.5;
    for (std::vector<double>* values : {&lack.Fluence, &lack.Illuminance})
    {
      for (double& value : *values)
      {
        value *= 0.5;
      }
    }
  }
  this->Blocks_.Complete(lack, batches);
  this->Completed_ = std::move(lack.Fluence);
  this->Sweeps_ = 0;
}

} // namespace smokevis
