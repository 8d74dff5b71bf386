// Runs long work for a VTK algorithm so that it reports how far it is and stops when it is asked
// to.
#pragma once

#include "Errors.h"
#include "Progress.h"

#include <vtkAlgorithm.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace smokevis
{

/// Keeps what was reported for another thread to read.
class SharedProgress : public Progress
{
public:
  void Report(double fraction) override
  {
    // Only the thread that does the work writes, so that nothing is lost in between.
    this->Fraction_.store(std::max(fraction, this->Fraction_.load()));
  }

  double Fraction() const { return this->Fraction_.load(); }

private:
  std::atomic<double> Fraction_{0.0};
};

/// Does work on a thread of its own, while the caller's thread, the only one that may talk to the
/// algorithm, reports its progress and listens for an abort twenty times a second: however long a
/// step of the work is, ShouldStop turns true at once. Returns when the work has ended, and throws
/// what it threw.
/// @param begin,end the algorithm's progress when the work begins and ends
inline void RunWithProgress(
  vtkAlgorithm* algorithm, double begin, double end, const std::function<void(Progress&)>& work)
{
  constexpr std::chrono::milliseconds interval(50);
  const auto checkAbort = [algorithm]
  {
    if (algorithm->CheckAbort())
    {
      throw Error("the work", "it was stopped", "Update again to have it done");
    }
  };
  checkAbort();
  SharedProgress progress;
  std::exception_ptr problem;
  std::mutex mutex;
  std::condition_variable ended;
  bool isDone = false;
  std::thread worker(
    [&]
    {
      try
      {
        work(progress);
      }
      catch (...)
      {
        problem = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(mutex);
      isDone = true;
      ended.notify_one();
    });
  const auto hasEnded = [&]
  {
    std::unique_lock<std::mutex> lock(mutex);
    return ended.wait_for(lock, interval, [&] { return isDone; });
  };
  while (!hasEnded())
  {
    algorithm->UpdateProgress(begin + progress.Fraction() * (end - begin));
    if (algorithm->CheckAbort())
    {
      progress.Stop();
    }
  }
  worker.join();
  if (problem)
  {
    std::rethrow_exception(problem);
  }
  algorithm->UpdateProgress(end);
  // The work may have been over before it noticed.
  checkAbort();
}

} // namespace smokevis
