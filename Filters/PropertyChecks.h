// Checks of the properties of filters, for use before work begins.
#pragma once

#include "Errors.h"

#include <cmath>
#include <string>

namespace smokevis
{

inline bool IsPositive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

inline bool IsNotNegative(double value)
{
  return value >= 0.0 && std::isfinite(value);
}

/// Throws Error where a property, or what it describes, is not good.
/// @param what   is wrong with it then
/// @param remedy what to set it to
inline void Check(
  bool isGood, const std::string& property, const std::string& what, const std::string& remedy)
{
  if (!isGood)
  {
    throw Error(property, what, remedy);
  }
}

inline void CheckPositive(double value, const char* property, const char* remedy)
{
  Check(IsPositive(value), property, "it is not positive", remedy);
}

inline void CheckNotNegative(double value, const char* property, const char* remedy)
{
  Check(IsNotNegative(value), property, "it is negative", remedy);
}

} // namespace smokevis
