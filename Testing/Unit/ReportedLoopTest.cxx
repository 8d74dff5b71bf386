// A loop over many threads that tells how far it is.
#include "ReportedLoop.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace
{

using namespace smokevis;

TEST(ReportedLoop, NothingToDoIsDone)
{
  tbb::task_arena arena(2);
  const Progress progress;
  std::vector<double> reports;
  ReportedLoop(
    arena, 0, 1, progress, [&](double share) { reports.push_back(share); },
    [](std::size_t) { FAIL(); });
  EXPECT_EQ(reports, std::vector<double>{1.0});
}

TEST(ReportedLoop, EveryItemOnceAndReportsThatRiseOnTheThreadThatCalls)
{
  tbb::task_arena arena(3);
  const Progress progress;
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<double> reports;
  std::vector<std::atomic<int>> calls(1000);
  ReportedLoop(
    arena, calls.size(), 3, progress,
    [&](double share)
    {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      reports.push_back(share);
    },
    [&](std::size_t i) { ++calls[i]; });
  for (const std::atomic<int>& count : calls)
  {
    EXPECT_EQ(count, 1);
  }
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_EQ(reports.back(), 1.0);
}

TEST(ReportedLoop, StopsWithoutSayingThatItIsDone)
{
  tbb::task_arena arena(1);
  Progress progress;
  std::vector<double> reports;
  std::size_t calls = 0;
  ReportedLoop(
    arena, 1000, 10, progress, [&](double share) { reports.push_back(share); },
    [&](std::size_t)
    {
      if (++calls == 25)
      {
        progress.Stop();
      }
    });
  EXPECT_EQ(calls, 25U);
  EXPECT_TRUE(reports.empty() || reports.back() < 1.0);
}

} // namespace
