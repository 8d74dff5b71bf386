// Sums over all cells that are the same from any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace smokevis
{

/// @param nothing value of no cells
/// @param add(value, cell) adds a cell
/// @param join(value, value) of both
template <class Value, class Add, class Join>
Value ReduceCells(std::size_t cells, const Value& nothing, Add&& add, Join&& join)
{
  return tbb::parallel_deterministic_reduce(
    tbb::blocked_range<std::size_t>(0, cells, 65536), nothing,
    [&add](const tbb::blocked_range<std::size_t>& range, Value value)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        add(value, static_cast<std::int64_t>(cell));
      }
      return value;
    },
    join);
}

} // namespace smokevis
