#include "RowLoops.h"

#include <limits>

// The loops are compiled twice: for every machine, and for those with registers of eight values.
// They have no branch inside, so that the compiler takes several values at a time.
#define SMOKEVIS_INLINE inline __attribute__((always_inline))
#ifdef __x86_64__
#define SMOKEVIS_WIDE __attribute__((target("avx2")))
#else
#define SMOKEVIS_WIDE
#endif

namespace smokevis
{

namespace
{

SMOKEVIS_INLINE int IsBad(float value)
{
  return static_cast<int>(!(value >= MostNegativeExtinction)) |
         static_cast<int>(!(value <= std::numeric_limits<float>::max()));
}

SMOKEVIS_INLINE float NotNegative(float value)
{
  return value > 0.0F ? value : 0.0F;
}

SMOKEVIS_INLINE float Mean(const float* before, const float* sums, std::size_t i)
{
  return 0.125F * ((before[i] + before[i + 1]) + (sums[i] + sums[i + 1]));
}

SMOKEVIS_INLINE void Sum(
  const float* nearer, const float* farther, float* __restrict__ sums, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    sums[i] = nearer[i] + farther[i];
  }
}

SMOKEVIS_INLINE void Means(
  const float* before, const float* sums, float* __restrict__ means, std::size_t cells)
{
  for (std::size_t i = 0; i < cells; ++i)
  {
    means[i] = Mean(before, sums, i);
  }
}

SMOKEVIS_INLINE bool CopyMeans(
  const float* before, const float* sums, float* __restrict__ target, std::size_t cells)
{
  int bad = 0;
  for (std::size_t i = 0; i < cells; ++i)
  {
    const float value = Mean(before, sums, i);
    bad |= IsBad(value);
    target[i] = NotNegative(value);
  }
  return bad == 0;
}

SMOKEVIS_INLINE bool Copy(const float* values, float* __restrict__ target, std::size_t count)
{
  int bad = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    bad |= IsBad(values[i]);
    target[i] = NotNegative(values[i]);
  }
  return bad == 0;
}

SMOKEVIS_INLINE bool Add(
  const float* values, float weight, float* __restrict__ target, std::size_t count)
{
  int bad = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    bad |= IsBad(values[i]);
    target[i] += weight * NotNegative(values[i]);
  }
  return bad == 0;
}

SMOKEVIS_WIDE void WideSum(const float* a, const float* b, float* sums, std::size_t count)
{
  Sum(a, b, sums, count);
}

SMOKEVIS_WIDE void WideMeans(const float* a, const float* b, float* means, std::size_t cells)
{
  Means(a, b, means, cells);
}

SMOKEVIS_WIDE bool WideCopyMeans(const float* a, const float* b, float* target, std::size_t cells)
{
  return CopyMeans(a, b, target, cells);
}

SMOKEVIS_WIDE bool WideCopy(const float* values, float* target, std::size_t count)
{
  return Copy(values, target, count);
}

SMOKEVIS_WIDE bool WideAdd(const float* values, float weight, float* target, std::size_t count)
{
  return Add(values, weight, target, count);
}

bool IsWide()
{
#ifdef __x86_64__
  static const bool wide = __builtin_cpu_supports("avx2") != 0;
  return wide;
#else
  return false;
#endif
}

} // namespace

//------------------------------------------------------------------------------------------------
bool IsExtinction(float value)
{
  return IsBad(value) == 0;
}

//------------------------------------------------------------------------------------------------
void AddRows(const float* nearer, const float* farther, std::span<float> sums)
{
  IsWide() ? WideSum(nearer, farther, sums.data(), sums.size())
           : Sum(nearer, farther, sums.data(), sums.size());
}

//------------------------------------------------------------------------------------------------
void MeansOfNodes(const float* before, const float* sums, std::span<float> means)
{
  IsWide() ? WideMeans(before, sums, means.data(), means.size())
           : Means(before, sums, means.data(), means.size());
}

//------------------------------------------------------------------------------------------------
bool CopyExtinctionOfNodes(const float* before, const float* sums, std::size_t cells, float* target)
{
  return IsWide() ? WideCopyMeans(before, sums, target, cells)
                  : CopyMeans(before, sums, target, cells);
}

//------------------------------------------------------------------------------------------------
bool CopyExtinction(std::span<const float> values, float* target)
{
  return IsWide() ? WideCopy(values.data(), target, values.size())
                  : Copy(values.data(), target, values.size());
}

//------------------------------------------------------------------------------------------------
bool AddExtinction(std::span<const float> values, float weight, float* target)
{
  return IsWide() ? WideAdd(values.data(), weight, target, values.size())
                  : Add(values.data(), weight, target, values.size());
}

} // namespace smokevis
