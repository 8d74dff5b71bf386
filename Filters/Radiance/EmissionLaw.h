// How the luminance of a plate depends on the direction that it is seen from.
#pragma once

#include "IntensityTable.h"
#include "Types.h"

#include <cmath>

namespace smokevis
{

/// Luminance over the plate's Luminance: a power of the cosine of the angle to the normal, or what
/// makes the intensity that of a table.
class EmissionLaw
{
public:
  /// Lambertian.
  EmissionLaw() = default;
  explicit EmissionLaw(double exponent)
      : Exponent_(exponent), Whole_(exponent <= LargestWhole ? static_cast<int>(exponent) : 0)
  {
  }
  /// Throws Error where the axis is parallel to the normal.
  /// @param table must outlive the law
  /// @param axis direction in the plate's plane (its part along the normal does not count) where
  /// the table's azimuth is 0; the azimuth grows from there towards cross(axis, normal), as it does
  /// counter-clockwise from above for a lamp that shines down
  EmissionLaw(const IntensityTable& table, const Vec3& axis, const Vec3& normal);

  /// Luminance towards a unit direction before the plate, whose cosine with the normal is given.
  double Relative(const Vec3& towards, double cosine) const
  {
    if (this->Table_)
    {
      return cosine > 0.0 ? this->Table_->Value(glm::dot(towards, this->AxisX_),
                              glm::dot(towards, this->AxisY_), cosine) /
                              cosine
                          : 0.0;
    }
    return this->Exponent_ == this->Whole_ ? this->WholePower(cosine)
                                           : std::pow(cosine, this->Exponent_);
  }

  /// Largest luminous intensity of a unit area of unit luminance [cd].
  double LargestIntensity() const { return this->Table_ ? this->Table_->Largest() : 1.0; }
  /// Luminous flux of a unit area of unit luminance [lm]: 2 pi / (n + 2), or pi with a table.
  double UnitFlux() const;
  /// Power of the cosine that the luminance goes with; 0 with a table.
  double Exponent() const { return this->Exponent_; }
  /// Whether a measured table gives the law.
  bool Measured() const { return this->Table_ != nullptr; }
  /// Whether luminance is the same in all directions.
  bool Lambertian() const { return this->Table_ == nullptr && this->Exponent_ == 0.0; }
  /// How fast the light changes with the angle, at least 1 [1/rad]; no more than cells are cut for.
  double Sharpness() const;
  /// The same, no more than leaves of a light are cut for, which costs less.
  double LeafSharpness() const;
  /// How many times as large as elsewhere parts of a light, and of what it shines on, may be where
  /// its law leaves little: 1 or more. Infinite: what it sends there does not matter.
  /// @param height over the light's plane of all that it shines on, at most
  /// @param distance of all that from the light, at least; negative where they may touch
  double Coarseness(double height, double distance) const;
  /// Whether the light of two plates with one normal can be added up.
  bool operator==(const EmissionLaw& other) const
  {
    return this->Exponent_ == other.Exponent_ && this->Table_ == other.Table_ &&
           this->AxisX_ == other.AxisX_;
  }

private:
  /// A whole exponent up to which products take less time than std::pow.
  static constexpr double LargestWhole = 128.0;

  double WholePower(double cosine) const
  {
    double power = 1.0;
    for (int left = this->Whole_; left > 0; left /= 2)
    {
      power *= left % 2 == 1 ? cosine : 1.0;
      cosine *= cosine;
    }
    return power;
  }
  /// At least 1 and at most a number.
  double SharpnessUpTo(double most) const;

  double Exponent_ = 0.0;
  /// Exponent_ where that is whole and no larger than products serve.
  int Whole_ = 0;
  const IntensityTable* Table_ = nullptr;
  Vec3 AxisX_{0.0};
  Vec3 AxisY_{0.0};
};

} // namespace smokevis
