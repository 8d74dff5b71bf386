#include "Types.h"

#include <cmath>

namespace smokevis
{

double Mean(const Lanes& lanes)
{
  double sum = 0.0;
  for (const float value : lanes.Value)
  {
    sum += value;
  }
  return sum / Batches;
}

double StandardError(const Lanes& lanes)
{
  const double mean = Mean(lanes);
  double squares = 0.0;
  for (const float value : lanes.Value)
  {
    squares += (value - mean) * (value - mean);
  }
  return FewBatches * std::sqrt(squares / (Batches * (Batches - 1.0)));
}

} // namespace smokevis
