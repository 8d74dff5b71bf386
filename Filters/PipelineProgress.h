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
#include <utility>

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

  /// For the work: has an errand run on the caller's thread, and throws what it throws.
  void OnCallersThread(const std::function<void()>& errand)
  {
    std::unique_lock<std::mutex> lock(this->Mutex_);
    this->Errand_ = &errand;
    this->Changed_.notify_all();
    this->Changed_.wait(lock, [this] { return !this->Errand_; });
    if (this->Problem_)
    {
      std::rethrow_exception(std::exchange(this->Problem_, nullptr));
    }
  }
  /// For the work: it has ended.
  void SetDone()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex_);
    this->IsDone_ = true;
    this->Changed_.notify_all();
  }
  /// For the caller: waits a while, runs the errand that the work sends it on, if any, and returns
  /// whether the work has ended.
  bool Attend(std::chrono::milliseconds interval)
  {
    std::unique_lock<std::mutex> lock(this->Mutex_);
    this->Changed_.wait_for(lock, interval, [this] { return this->IsDone_ || this->Errand_; });
    if (this->Errand_)
    {
      // The work does nothing until this is over.
      try
      {
        (*this->Errand_)();
      }
      catch (...)
      {
        this->Problem_ = std::current_exception();
      }
      this->Errand_ = nullptr;
      this->Changed_.notify_all();
    }
    return this->IsDone_;
  }

private:
  std::atomic<double> Fraction_{0.0};
  std::mutex Mutex_;
  std::condition_variable Changed_;
  /// Null: none, or done.
  const std::function<void()>* Errand_ = nullptr;
  std::exception_ptr Problem_;
  bool IsDone_ = false;
};

/// Does work on a thread of its own, while the caller's thread, the only one that may talk to the
/// algorithm, reports its progress and listens for an abort twenty times a second: however long a
/// step of the work is, ShouldStop turns true at once. Returns when the work has ended, and throws
/// what it threw.
/// @param begin,end the algorithm's progress when the work begins and ends
/// @param hears asked as often as for an abort, and may likewise have the work stopped
inline void RunWithProgress(vtkAlgorithm* algorithm, double begin, double end,
  const std::function<void(SharedProgress&)>& work, const std::function<bool()>& hears = {})
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
      progress.SetDone();
    });
  while (!progress.Attend(interval))
  {
    algorithm->UpdateProgress(begin + progress.Fraction() * (end - begin));
    if (algorithm->CheckAbort() || (hears && hears()))
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
