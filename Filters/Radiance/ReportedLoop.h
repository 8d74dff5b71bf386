// A loop over many threads that tells on the way how far it is.
#pragma once

#include "Progress.h"

#include <atomic>
#include <cstddef>
#include <thread>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace smokevis
{

/// Calls body(i) for i below a count, in any order, until the work is to stop, and
/// report(share done) now and then, on the thread that calls this.
/// @param grain how many of them are worth a task
template <class Report, class Body>
void ReportedLoop(tbb::task_arena& arena, std::size_t count, std::size_t grain,
  const Progress& progress, Report&& report, Body&& body)
{
  constexpr double Reports = 50.0;
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> done{0};
  double reported = 0.0;
  arena.execute(
    [&]
    {
      tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range)
        {
          for (std::size_t i = range.begin(); i < range.end() && !progress.ShouldStop(); ++i)
          {
            body(i);
          }
          const std::size_t all = done.fetch_add(range.size(), std::memory_order_relaxed);
          const double share = static_cast<double>(all + range.size()) / static_cast<double>(count);
          if (std::this_thread::get_id() == caller && share >= reported + 1.0 / Reports)
          {
            reported = share;
            report(share);
          }
        },
        tbb::simple_partitioner());
    });
  if (!progress.ShouldStop())
  {
    report(1.0);
  }
}

} // namespace smokevis
