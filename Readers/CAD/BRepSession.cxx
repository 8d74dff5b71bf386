// Prepares Open CASCADE for reading a file.
#include "BRepSession.h"

#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <OSD.hxx>
#include <STEPControl_Controller.hxx>

namespace smokevis
{
namespace
{

constexpr std::size_t LongestText = 300;

/// The signals that Open CASCADE takes over. The first four come of invalid addresses and numbers;
/// the others belong to whoever runs this process.
constexpr std::array<int, 8> Signals = {
  SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGQUIT, SIGHUP, SIGSYS};
constexpr std::size_t Converted = 4;

std::mutex& SessionMutex()
{
  static std::mutex mutex;
  return mutex;
}

} // namespace

//------------------------------------------------------------------------------------------------
void BRepMessages::send(const TCollection_AsciiString& text, const Message_Gravity gravity) const
{
  if (gravity < Message_Fail)
  {
    return;
  }
  const std::lock_guard<std::mutex> lock(this->Mutex_);
  for (const char c : std::string_view(text.ToCString(), text.Length()))
  {
    const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ' || c == '*';
    if (this->Text_.size() < LongestText &&
        !(blank && (this->Text_.empty() || this->Text_.back() == ' ')))
    {
      this->Text_ += blank ? ' ' : c;
    }
  }
  if (!this->Text_.empty() && this->Text_.back() != ' ')
  {
    this->Text_ += ' ';
  }
}

//------------------------------------------------------------------------------------------------
BRepSession::BRepSession() : Lock_(SessionMutex()), Messages_(new BRepMessages)
{
  Message_SequenceOfPrinters& printers = Message::DefaultMessenger()->ChangePrinters();
  this->Printers_ = printers;
  printers.Clear();
  printers.Append(this->Messages_);
  for (std::size_t i = 0; i < Signals.size(); ++i)
  {
    sigaction(Signals[i], nullptr, &this->Actions_[i]);
  }
  OSD::SetSignal(OSD_SignalMode_Set, false);
  for (std::size_t i = Converted; i < Signals.size(); ++i)
  {
    sigaction(Signals[i], &this->Actions_[i], nullptr);
  }
  STEPControl_Controller::Init();
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
}

//------------------------------------------------------------------------------------------------
BRepSession::~BRepSession()
{
  for (std::size_t i = 0; i < Converted; ++i)
  {
    sigaction(Signals[i], &this->Actions_[i], nullptr);
  }
  Message::DefaultMessenger()->ChangePrinters() = this->Printers_;
}

} // namespace smokevis
