#include "ThinLens.h"

#include "Errors.h"

#include <cmath>
#include <string>

namespace smokevis
{
namespace
{

void CheckFocalLength(double focalLength)
{
  if (!(focalLength > 0.0) || !std::isfinite(focalLength))
  {
    throw Error("lens", "its focal length is not positive", "Give a FocalLength in mm");
  }
}

} // namespace

//------------------------------------------------------------------------------
ThinLens ThinLens::FocusedAtInfinity(double focalLength)
{
  CheckFocalLength(focalLength);
  return {focalLength, ThinLens().ObjectDistance, focalLength};
}

//------------------------------------------------------------------------------
ThinLens ThinLens::Focused(double focalLength, double planeToSensor)
{
  CheckFocalLength(focalLength);
  // s and s' are the roots of x^2 - S x + f S = 0.
  const double discriminant = planeToSensor - 4.0 * focalLength;
  if (!(discriminant >= 0.0) || !std::isfinite(planeToSensor))
  {
    throw Error("lens",
      "it cannot be focused on a plane " + std::to_string(planeToSensor) +
        " m from the sensor, which is nearer than four focal lengths",
      "Give a FocusDistance of at least " + std::to_string(4.0 * focalLength) +
        " m, or 0 for infinity");
  }
  const double object = 0.5 * (planeToSensor + std::sqrt(planeToSensor) * std::sqrt(discriminant));
  // From the product of the roots, without cancellation.
  return {focalLength, object, focalLength * planeToSensor / object};
}

//------------------------------------------------------------------------------
double ThinLens::Magnification() const
{
  return this->ImageDistance / this->ObjectDistance;
}

//------------------------------------------------------------------------------
double ThinLens::BlurDiameter(double aperture, double distance) const
{
  return aperture * this->ImageDistance * std::abs(1.0 / distance - 1.0 / this->ObjectDistance);
}

} // namespace smokevis
