#include "EyeProperties.h"

#include "Errors.h"

#include <cmath>
#include <limits>
#include <string>

#include <glm/trigonometric.hpp>

namespace smokevis
{
namespace
{

/// Hundreds of suns [cd/m2]: above it there is nothing, but single precision ends.
constexpr double LargestLuminance = 1e12;
/// Half a turn [minutes of arc].
constexpr double LargestAcuity = 10800.0;
constexpr double NoLimit = std::numeric_limits<double>::max();

void CheckFromZero(double value, double most, const std::string& name, const std::string& remedy)
{
  if (!(value >= 0.0 && value <= most))
  {
    throw Error(name,
      !std::isfinite(value) ? "it is not finite"
      : value < 0.0         ? "it is negative"
                            : "it is too large",
      remedy);
  }
}

} // namespace

//------------------------------------------------------------------------------
Observer CheckedEye(double darkLuminance, double acuity, const Adaptation& state)
{
  CheckFromZero(
    darkLuminance, LargestLuminance, "DarkLuminance", "Give a luminance in cd/m2 from 0 to 1e12");
  CheckFromZero(acuity, LargestAcuity, "Acuity", "Give minutes of arc from 0 to 10800");
  CheckFromZero(state.Luminance, LargestLuminance, "AdaptationLuminance",
    "Give a luminance in cd/m2 from 0 to 1e12");
  CheckFromZero(state.Time, NoLimit, "AdaptationTime", "Give seconds from 0");
  if (!(state.Age >= 0.0 && state.Age <= 100.0))
  {
    throw Error("ObserverAge", "it is not from 0 to 100", "Give years");
  }
  return {darkLuminance, glm::radians(acuity / 60.0)};
}

} // namespace smokevis
