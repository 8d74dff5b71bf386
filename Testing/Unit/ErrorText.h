// What errors say.
#pragma once

#include "Errors.h"

#include <string>

namespace smokevis::test
{

/// The message of the error that an action ends in, or "no error".
template <class Action> std::string ErrorText(Action&& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "no error";
}

} // namespace smokevis::test
