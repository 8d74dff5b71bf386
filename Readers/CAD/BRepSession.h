// What must surround every use of Open CASCADE: its data exchange works with global settings and
// talks to the console.
#pragma once

#include "CrashGuard.h"
#include "Progress.h"

#include <Message_Printer.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Message_SequenceOfPrinters.hxx>

#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace smokevis
{

/// Keeps the failures that Open CASCADE reports.
class BRepMessages : public Message_Printer
{
public:
  /// The first failures, in one line.
  const std::string& Text() const { return this->Text_; }

protected:
  void send(const TCollection_AsciiString& text, const Message_Gravity gravity) const override;

private:
  mutable std::mutex Mutex_;
  mutable std::string Text_;
};

/// While one is alive no other thread reads a file through Open CASCADE, its messages go to
/// Messages and lengths come in millimetres.
class BRepSession
{
public:
  BRepSession();
  ~BRepSession();
  BRepSession(const BRepSession&) = delete;
  BRepSession& operator=(const BRepSession&) = delete;

  const std::string& Messages() const { return this->Messages_->Text(); }
  /// Does work with Open CASCADE; what failed in it, or blank.
  std::string Run(const std::function<void()>& work) const { return this->Guard_.Run(work); }

private:
  CrashGuard Guard_;
  Handle(BRepMessages) Messages_;
  Message_SequenceOfPrinters Printers_;
};

/// Passes the progress of Open CASCADE on, and the wish to stop to it.
class BRepProgress : public Message_ProgressIndicator
{
public:
  explicit BRepProgress(Progress& progress)
      : Progress_(progress), Thread_(std::this_thread::get_id())
  {
  }

protected:
  Standard_Boolean UserBreak() override { return this->Progress_.ShouldStop(); }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override
  {
    // Tessellation calls from its workers too.
    if (std::this_thread::get_id() == this->Thread_)
    {
      this->Progress_.Report(this->GetPosition());
    }
  }

private:
  Progress& Progress_;
  std::thread::id Thread_;
};

} // namespace smokevis
