#include "EyeProperties.h"

#include "Errors.h"

#include <cmath>
#include <string>

#include <glm/trigonometric.hpp>

namespace smokevis
{
namespace
{

void CheckFromZero(double value, const std::string& name, const std::string& remedy)
{
  if (!(value >= 0.0) || !std::isfinite(value))
  {
    throw Error(name, std::isfinite(value) ? "it is negative" : "it is not finite", remedy);
  }
}

} // namespace

//------------------------------------------------------------------------------
Observer CheckedEye(double darkLuminance, double acuity, const Adaptation& state)
{
  CheckFromZero(darkLuminance, "DarkLuminance", "Give a luminance in cd/m2 from 0");
  CheckFromZero(acuity, "Acuity", "Give minutes of arc from 0");
  CheckFromZero(state.Luminance, "AdaptationLuminance", "Give a luminance in cd/m2 from 0");
  CheckFromZero(state.Time, "AdaptationTime", "Give seconds from 0");
  if (!(state.Age >= 0.0 && state.Age <= 100.0))
  {
    throw Error("ObserverAge", "it is not from 0 to 100", "Give years");
  }
  return {darkLuminance, glm::radians(acuity / 60.0)};
}

} // namespace smokevis
