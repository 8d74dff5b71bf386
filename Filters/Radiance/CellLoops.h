// Loops over all cells on all threads, and sums that are the same from any number of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace smokevis
{

/// Calls visit(cell), which may change what belongs to the cell alone.
template <class Visit> void ForEachCell(std::size_t cells, Visit&& visit)
{
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 4096),
    [&visit](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        visit(static_cast<std::int64_t>(cell));
      }
    });
}

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

/// How many cells are(cell) is true of.
template <class Are> std::size_t CountCells(std::size_t cells, Are&& are)
{
  return ReduceCells(
    cells, std::size_t{0},
    [&are](std::size_t& count, std::int64_t cell) { count += are(cell) ? 1 : 0; },
    std::plus<std::size_t>());
}

} // namespace smokevis
