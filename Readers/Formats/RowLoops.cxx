#include "RowLoops.h"

#include <cstring>
#include <limits>
#include <utility>
#include <vector>

// The loops are compiled twice: for every machine, with registers of four values, and for those of
// eight. The last values of a row are handled together with some before them again, which gives the
// same, rather than one by one.
#define SMOKEVIS_INLINE inline __attribute__((always_inline))
#ifdef __x86_64__
#define SMOKEVIS_WIDE __attribute__((target("avx2")))
#else
#define SMOKEVIS_WIDE
#endif

// All of it is inlined: how registers of eight values would be handed over does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace smokevis
{

namespace
{

constexpr float Greatest = std::numeric_limits<float>::max();

/// As many values as a register holds, and a mask for each of them.
template <int Width> struct Lanes
{
  typedef float Values __attribute__((vector_size(Width * sizeof(float))));
  typedef int Marks __attribute__((vector_size(Width * sizeof(int))));
};

template <int Width> SMOKEVIS_INLINE typename Lanes<Width>::Values Load(const float* from)
{
  typename Lanes<Width>::Values values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}

template <int Width> SMOKEVIS_INLINE void Store(float* to, typename Lanes<Width>::Values values)
{
  std::memcpy(to, &values, sizeof(values));
}

/// Extinction that is stored somewhere, and whether all of it can be such.
template <int Width> class Checked
{
public:
  using Values = typename Lanes<Width>::Values;

  SMOKEVIS_INLINE Values NotNegative(Values values)
  {
    const Values zero{};
    const Values kept = values > zero ? values : zero;
    // What was taken off a negative value; NaN for NaN and for infinity.
    good_ &= kept - values <= -MostNegativeExtinction;
    return kept;
  }

  SMOKEVIS_INLINE bool Good() const
  {
    bool all = true;
    for (int i = 0; i < Width; ++i)
    {
      all = all && good_[i] != 0;
    }
    return all;
  }

private:
  typename Lanes<Width>::Marks good_ = ~typename Lanes<Width>::Marks{};
};

/// The place after @p i in steps of Width; the last step ends at @p count, which is at least Width.
template <int Width> SMOKEVIS_INLINE std::size_t Next(std::size_t i, std::size_t count)
{
  const std::size_t next = i + Width;
  return next + Width <= count || next >= count ? next : count - Width;
}

template <int Width>
SMOKEVIS_INLINE bool CopyRows(const StoredRows& cells, float* target, std::size_t targetStride)
{
  Checked<Width> checked;
  const float* row = cells.First;
  for (std::size_t j = 0; j < cells.Rows; ++j, row += cells.Stride, target += targetStride)
  {
    for (std::size_t i = 0; i < cells.Cells; i = Next<Width>(i, cells.Cells))
    {
      Store<Width>(target + i, checked.NotNegative(Load<Width>(row + i)));
    }
  }
  return checked.Good();
}

/// The sums of four nodes each: two neighbours in a row, and those above them.
template <int Width>
SMOKEVIS_INLINE typename Lanes<Width>::Values SumOfFour(const float* nodes, std::size_t layer)
{
  return (Load<Width>(nodes) + Load<Width>(nodes + layer)) +
         (Load<Width>(nodes + 1) + Load<Width>(nodes + layer + 1));
}

/// The means of so many rows of cells at a time, column by column of registers, so that most sums
/// of four nodes stay in them. @p before has those of the row of nodes below; @p after gets those
/// of the last. @p row is the row of nodes below.
template <int Width, int Rows>
SMOKEVIS_INLINE void CopyMeansOfRows(const StoredRows& nodes, const float* row, float* target,
  std::size_t targetStride, const float* before, float* after, Checked<Width>& checked)
{
  for (std::size_t i = 0; i < nodes.Cells; i = Next<Width>(i, nodes.Cells))
  {
    typename Lanes<Width>::Values below = Load<Width>(before + i);
    for (int j = 0; j < Rows; ++j)
    {
      const typename Lanes<Width>::Values sum =
        SumOfFour<Width>(row + (j + 1) * nodes.Stride + i, nodes.Layer);
      Store<Width>(target + j * targetStride + i, checked.NotNegative(0.125F * (below + sum)));
      below = sum;
    }
    Store<Width>(after + i, below);
  }
}

template <int Width>
SMOKEVIS_INLINE bool CopyMeans(
  const StoredRows& nodes, float* target, std::size_t targetStride, float* before, float* after)
{
  // More need more registers than there are.
  constexpr int together = 4;
  Checked<Width> checked;
  const float* row = nodes.First;
  for (std::size_t i = 0; i < nodes.Cells; i = Next<Width>(i, nodes.Cells))
  {
    Store<Width>(before + i, SumOfFour<Width>(row + i, nodes.Layer));
  }
  std::size_t j = 0;
  for (; j + together <= nodes.Rows; j += together)
  {
    CopyMeansOfRows<Width, together>(nodes, row, target, targetStride, before, after, checked);
    row += together * nodes.Stride;
    target += together * targetStride;
    std::swap(before, after);
  }
  for (; j < nodes.Rows; ++j, row += nodes.Stride, target += targetStride)
  {
    CopyMeansOfRows<Width, 1>(nodes, row, target, targetStride, before, after, checked);
    std::swap(before, after);
  }
  return checked.Good();
}

template <int Width>
SMOKEVIS_INLINE void Means(
  const float* row, std::size_t stride, std::size_t layer, float* means, std::size_t cells)
{
  for (std::size_t i = 0; i < cells; i = Next<Width>(i, cells))
  {
    Store<Width>(means + i,
      0.125F * (SumOfFour<Width>(row + i, layer) + SumOfFour<Width>(row + stride + i, layer)));
  }
}

// Each value once: no step may reach back.
SMOKEVIS_INLINE bool Add(
  const float* values, float weight, float* __restrict__ target, std::size_t count)
{
  bool good = true;
  for (std::size_t i = 0; i < count; ++i)
  {
    good &= (values[i] >= MostNegativeExtinction) & (values[i] <= Greatest);
    target[i] += weight * (values[i] > 0.0F ? values[i] : 0.0F);
  }
  return good;
}

constexpr int WideWidth = 8;
constexpr int PlainWidth = 4;

SMOKEVIS_WIDE bool WideCopyRows(const StoredRows& cells, float* target, std::size_t targetStride)
{
  return CopyRows<WideWidth>(cells, target, targetStride);
}

SMOKEVIS_WIDE bool WideCopyMeans(
  const StoredRows& nodes, float* target, std::size_t targetStride, float* before, float* after)
{
  return CopyMeans<WideWidth>(nodes, target, targetStride, before, after);
}

SMOKEVIS_WIDE void WideMeans(
  const float* row, std::size_t stride, std::size_t layer, float* means, std::size_t cells)
{
  Means<WideWidth>(row, stride, layer, means, cells);
}

SMOKEVIS_WIDE bool WideAdd(const float* values, float weight, float* target, std::size_t count)
{
  return Add(values, weight, target, count);
}

// How many values are taken at a time in rows of that many cells.
int WidthFor(std::size_t cells)
{
#ifdef __x86_64__
  static const bool wide = __builtin_cpu_supports("avx2") != 0;
#else
  static const bool wide = false;
#endif
  return wide && cells >= WideWidth ? WideWidth : cells >= PlainWidth ? PlainWidth : 1;
}

} // namespace

//------------------------------------------------------------------------------------------------
bool IsExtinction(float value)
{
  return value >= MostNegativeExtinction && value <= Greatest;
}

//------------------------------------------------------------------------------------------------
void MeansOfNodes(const float* row, std::size_t stride, std::size_t layer, std::span<float> means)
{
  switch (WidthFor(means.size()))
  {
  case WideWidth:
    WideMeans(row, stride, layer, means.data(), means.size());
    break;
  case PlainWidth:
    Means<PlainWidth>(row, stride, layer, means.data(), means.size());
    break;
  default:
    Means<1>(row, stride, layer, means.data(), means.size());
  }
}

//------------------------------------------------------------------------------------------------
bool CopyExtinction(std::span<const float> values, float* target)
{
  return CopyExtinction({values.data(), 0, 0, values.size(), 1}, target, 0);
}

//------------------------------------------------------------------------------------------------
bool CopyExtinction(const StoredRows& cells, float* target, std::size_t targetStride)
{
  switch (WidthFor(cells.Cells))
  {
  case WideWidth:
    return WideCopyRows(cells, target, targetStride);
  case PlainWidth:
    return CopyRows<PlainWidth>(cells, target, targetStride);
  default:
    return CopyRows<1>(cells, target, targetStride);
  }
}

//------------------------------------------------------------------------------------------------
bool CopyExtinctionOfNodes(const StoredRows& nodes, float* target, std::size_t targetStride)
{
  std::vector<float> before(nodes.Cells);
  std::vector<float> after(nodes.Cells);
  switch (WidthFor(nodes.Cells))
  {
  case WideWidth:
    return WideCopyMeans(nodes, target, targetStride, before.data(), after.data());
  case PlainWidth:
    return CopyMeans<PlainWidth>(nodes, target, targetStride, before.data(), after.data());
  default:
    return CopyMeans<1>(nodes, target, targetStride, before.data(), after.data());
  }
}

//------------------------------------------------------------------------------------------------
bool AddExtinction(std::span<const float> values, float weight, float* target)
{
  return WidthFor(values.size()) == WideWidth
           ? WideAdd(values.data(), weight, target, values.size())
           : Add(values.data(), weight, target, values.size());
}

} // namespace smokevis
