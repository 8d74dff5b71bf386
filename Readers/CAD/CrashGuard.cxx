// Borrows the handlers by which Open CASCADE turns signals into exceptions.
#include "CrashGuard.h"

#include <OSD.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Type.hxx>

namespace smokevis
{
namespace
{

/// The signals that Open CASCADE takes over. The first four come of invalid addresses and numbers;
/// the others belong to whoever runs this process.
constexpr std::array<int, 8> Signals = {
  SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGQUIT, SIGHUP, SIGSYS};
constexpr std::size_t Converted = 4;

std::mutex& GuardMutex()
{
  static std::mutex mutex;
  return mutex;
}

} // namespace

//------------------------------------------------------------------------------------------------
CrashGuard::CrashGuard() : Lock_(GuardMutex())
{
  for (std::size_t i = 0; i < Signals.size(); ++i)
  {
    sigaction(Signals[i], nullptr, &this->Actions_[i]);
  }
  OSD::SetSignal(OSD_SignalMode_Set, false);
  for (std::size_t i = Converted; i < Signals.size(); ++i)
  {
    sigaction(Signals[i], &this->Actions_[i], nullptr);
  }
}

//------------------------------------------------------------------------------------------------
CrashGuard::~CrashGuard()
{
  for (std::size_t i = 0; i < Converted; ++i)
  {
    sigaction(Signals[i], &this->Actions_[i], nullptr);
  }
}

//------------------------------------------------------------------------------------------------
std::string CrashGuard::Run(const std::function<void()>& work) const
{
  try
  {
    OCC_CATCH_SIGNALS
    work();
  }
  catch (const Standard_Failure& failure)
  {
    const char* const text = failure.GetMessageString();
    return failure.DynamicType()->Name() + (text && *text ? std::string(": ") + text : "");
  }
  return {};
}

} // namespace smokevis
