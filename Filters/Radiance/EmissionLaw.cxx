#include "EmissionLaw.h"

#include "Errors.h"

#include <algorithm>
#include <limits>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// A sharper light would have every cell before it cut to pieces, and the leaves of the light for
/// each place.
constexpr double MostSharpness = 4.0;
constexpr double MostLeafSharpness = 12.0;
/// Shares of what a plate as bright in all directions would send. Where less than the first is
/// left, parts may be so many times as large; less than the second, as large as they are.
constexpr double DimShare = 0.01;
constexpr double DimCoarseness = 2.0;
constexpr double FaintShare = 1e-8;

} // namespace

EmissionLaw::EmissionLaw(const IntensityTable& table, const Vec3& axis, const Vec3& normal)
    : Table_(&table)
{
  const Vec3 flat = axis - glm::dot(axis, normal) * normal;
  if (!(glm::length(flat) > 1e-6 * glm::length(axis)))
  {
    throw Error("lamp", "the axis of its intensity table is parallel to its normal",
      "Give a direction in the lamp's plane");
  }
  this->AxisX_ = glm::normalize(flat);
  this->AxisY_ = glm::cross(this->AxisX_, normal);
}

double EmissionLaw::UnitFlux() const
{
  return this->Table_ ? glm::pi<double>() : glm::two_pi<double>() / (this->Exponent_ + 2.0);
}

double EmissionLaw::Sharpness() const
{
  return this->SharpnessUpTo(MostSharpness);
}

double EmissionLaw::LeafSharpness() const
{
  return this->SharpnessUpTo(MostLeafSharpness);
}

double EmissionLaw::Coarseness(double height, double distance) const
{
  if (!(this->Exponent_ > 0.0) || height >= distance)
  {
    return 1.0;
  }
  const double share = std::pow(std::max(0.0, height) / distance, this->Exponent_);
  if (share < FaintShare)
  {
    return std::numeric_limits<double>::infinity();
  }
  return share < DimShare ? DimCoarseness : 1.0;
}

double EmissionLaw::SharpnessUpTo(double most) const
{
  // The steepest slope of cos^m is close to sqrt(m / e).
  const double own = this->Table_ ? this->Table_->Sharpness()
                                  : std::sqrt((this->Exponent_ + 1.0) / glm::e<double>());
  return std::clamp(own, 1.0, most);
}

} // namespace smokevis
