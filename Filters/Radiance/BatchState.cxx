#include "BatchState.h"

#include "LargePages.h"

#include <algorithm>

namespace smokevis
{

BatchState::BatchState(std::size_t cells, std::size_t sides)
    : Illuminance(sides, 0.0F), IlluminanceSum(sides, 0.0F)
{
  for (std::vector<float>* values : {&this->Fluence, &this->FluenceSum})
  {
    ReserveInLargePages(cells, *values);
    values->assign(cells, 0.0F);
  }
}

void BatchState::Restart()
{
  std::fill(this->FluenceSum.begin(), this->FluenceSum.end(), 0.0F);
  std::fill(this->IlluminanceSum.begin(), this->IlluminanceSum.end(), 0.0F);
  this->EscapedSum = 0.0;
  this->Counted = 0;
}

Lanes MeansOf(
  const std::vector<BatchState>& batches, std::vector<float> BatchState::*sums, std::size_t place)
{
  Lanes means;
  for (int batch = 0; batch < Batches; ++batch)
  {
    means[batch] =
      (batches[batch].*sums)[place] / static_cast<float>(std::max(1, batches[batch].Counted));
  }
  return means;
}

} // namespace smokevis
