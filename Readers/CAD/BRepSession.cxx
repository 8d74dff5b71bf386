// Prepares Open CASCADE for reading a file.
#include "BRepSession.h"

#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>

namespace smokevis
{
namespace
{

constexpr std::size_t LongestText = 300;

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
BRepSession::BRepSession() : Messages_(new BRepMessages)
{
  Message_SequenceOfPrinters& printers = Message::DefaultMessenger()->ChangePrinters();
  this->Printers_ = printers;
  printers.Clear();
  printers.Append(this->Messages_);
  STEPControl_Controller::Init();
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
}

//------------------------------------------------------------------------------------------------
BRepSession::~BRepSession()
{
  Message::DefaultMessenger()->ChangePrinters() = this->Printers_;
}

} // namespace smokevis
