// Number properties of readers and filters: set within a range, checked before work begins.
#pragma once

#include "Errors.h"

#include <vtkObject.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace smokevis
{

/// Sets a property as vtkSetClampMacro does, but keeps what is not finite, which would else become
/// an end of the range: CheckFinite refuses it by the property's name.
inline void SetClamped(
  vtkObject* owner, double& property, double value, double least, double greatest)
{
  const double kept = std::isfinite(value) ? std::clamp(value, least, greatest) : value;
  if (property != kept && !(std::isnan(property) && std::isnan(kept)))
  {
    property = kept;
    owner->Modified();
  }
}

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

inline void CheckFinite(const std::string& property, double value, const std::string& remedy)
{
  Check(std::isfinite(value), property,
    "it is " + std::to_string(value) + ", which is no finite number", remedy);
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
