#include "Types.h"

#include <cmath>

namespace smokevis
{

namespace
{

template <class Values> double MeanOf(const Values& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / Batches;
}

template <class Values> double StandardErrorOf(const Values& values)
{
  const double mean = MeanOf(values);
  double squares = 0.0;
  for (const double value : values)
  {
    squares += (value - mean) * (value - mean);
  }
  return FewBatches * std::sqrt(squares / (Batches * (Batches - 1.0)));
}

} // namespace

double Mean(const Lanes& lanes)
{
  return MeanOf(lanes.Value);
}

double Mean(const DoubleLanes& lanes)
{
  return MeanOf(lanes);
}

double StandardError(const Lanes& lanes)
{
  return StandardErrorOf(lanes.Value);
}

double StandardError(const DoubleLanes& lanes)
{
  return StandardErrorOf(lanes);
}

} // namespace smokevis
