// Number properties that keep what is not finite, for reading to refuse it by the property's name.
#ifndef FiniteProperty_h
#define FiniteProperty_h

#include "Errors.h"

#include "vtkObject.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smokevis
{

/// Sets a property as vtkSetClampMacro does, but does not turn what is not finite into an end of
/// the range.
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

/// Throws Error where a property is not a finite number.
/// @param remedy what to set it to
inline void CheckFinite(const std::string& property, double value, const std::string& remedy)
{
  if (!std::isfinite(value))
  {
    throw Error(property, "it is " + std::to_string(value) + ", which is no finite number", remedy);
  }
}

} // namespace smokevis

#endif
