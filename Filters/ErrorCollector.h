// Keeps the error messages of a VTK object that works inside another one, so that the user reads
// one message instead of several.
#pragma once

#include <vtkCommand.h>

#include <string>

namespace smokevis
{

/// Add to an object as observer of vtkCommand::ErrorEvent and vtkCommand::WarningEvent.
class ErrorCollector : public vtkCommand
{
public:
  static ErrorCollector* New() { return new ErrorCollector; }
  vtkTypeMacro(ErrorCollector, vtkCommand);

  void Execute(vtkObject*, unsigned long, void* data) override
  {
    if (this->Text_.empty() && data)
    {
      this->Text_ = static_cast<const char*>(data);
    }
  }

  /// The first message, or nothing.
  const std::string& Text() const { return this->Text_; }

private:
  std::string Text_;
};

} // namespace smokevis
