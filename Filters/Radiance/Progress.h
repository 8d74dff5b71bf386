// How long work reports how far it is and learns that it should stop.
#pragma once

#include "Errors.h"

#include <atomic>

namespace smokevis
{

/// Handed to long work. Report is called on the thread that started the work, ShouldStop on any.
class Progress
{
public:
  virtual ~Progress() = default;

  /// @param fraction of the work done, 0 to 1, never falling
  virtual void Report(double fraction) { static_cast<void>(fraction); }

  /// True once the work is to be given up.
  bool ShouldStop() const { return this->Stop_.load(std::memory_order_relaxed); }
  /// @param work what is given up, as the message says
  void ThrowIfStopped(const char* work) const
  {
    if (this->ShouldStop())
    {
      throw Error(work, "the work was stopped");
    }
  }
  /// Asks the work to stop.
  void Stop() { this->Stop_.store(true, std::memory_order_relaxed); }

private:
  std::atomic<bool> Stop_{false};
};

} // namespace smokevis
