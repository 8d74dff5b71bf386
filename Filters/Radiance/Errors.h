// The one exception type of the VTK-free core: what happened, where, and what to do about it.
#pragma once

#include "PrintableText.h"

#include <stdexcept>
#include <string>

namespace smokevis
{

/// Thrown by the readers of files and by the radiance solver; caught at the VTK boundary, where it
/// becomes one vtkErrorMacro. The message reads "<where>: <what happened>. <what to do>", and may
/// quote what a file holds: what cannot be shown is escaped.
class Error : public std::runtime_error
{
public:
  /// @param where  file and byte offset, or the quantity or object concerned
  /// @param what   what is wrong, a sentence without its full stop
  /// @param remedy what the user can do, a sentence without its full stop; may be empty
  Error(const std::string& where, const std::string& what, const std::string& remedy = {})
      : std::runtime_error(
          Printable(where + ": " + what + "." + (remedy.empty() ? "" : " " + remedy + ".")))
  {
  }
};

} // namespace smokevis
