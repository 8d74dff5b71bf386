#include "IntensityTable.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

constexpr double Degree = glm::pi<double>() / 180.0;
/// Angles in files are rounded.
constexpr double AngleTolerance = 1e-6;

/// Interval that holds a value, and the place in it from 0 to 1.
std::pair<std::size_t, double> Place(const std::vector<double>& nodes, double value)
{
  const auto after = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
  const std::size_t index = after - nodes.begin() - 1;
  const double share = (value - nodes[index]) / (nodes[index + 1] - nodes[index]);
  return {index, std::clamp(share, 0.0, 1.0)};
}

void CheckAngles(
  const std::vector<double>& angles, double last, const std::string& name, const std::string& where)
{
  const auto rises = [](double a, double b) { return !(a < b); };
  if (angles.size() < 2 || std::abs(angles.front()) > AngleTolerance ||
      !(std::abs(angles.back() - last) <= AngleTolerance) ||
      std::adjacent_find(angles.begin(), angles.end(), rises) != angles.end())
  {
    throw Error(where,
      "its " + name + " angles do not ascend from 0 to " + std::to_string(static_cast<int>(last)) +
        " degrees",
      "Give the distribution over the whole half-sphere");
  }
}

/// Integrals over an interval of polar angles of the sine times the falling and the rising linear
/// weight.
std::pair<double, double> SineWeights(double from, double to)
{
  const double a = from * Degree;
  const double b = to * Degree;
  const double all = std::cos(a) - std::cos(b);
  const double rising = (std::sin(b) - std::sin(a)) / (b - a) - std::cos(b);
  return {all - rising, rising};
}

} // namespace

double IntensityTable::Flux(const std::vector<double>& polar, const std::vector<double>& azimuth,
  const std::vector<double>& intensity)
{
  double flux = 0.0;
  for (std::size_t plane = 0; plane < azimuth.size(); ++plane)
  {
    double width = 360.0;
    if (azimuth.size() > 1)
    {
      const std::size_t next = std::min(plane + 1, azimuth.size() - 1);
      width = 0.5 * (azimuth[next] - azimuth[plane - std::min<std::size_t>(plane, 1)]);
    }
    for (std::size_t i = 0; i + 1 < polar.size(); ++i)
    {
      const auto [falling, rising] = SineWeights(polar[i], polar[i + 1]);
      const double* const values = &intensity[plane * polar.size() + i];
      flux += width * Degree * (falling * values[0] + rising * values[1]);
    }
  }
  return flux;
}

IntensityTable::IntensityTable(std::vector<double> polar, std::vector<double> azimuth,
  std::vector<double> intensity, const std::string& where)
    : Polar_(std::move(polar)), Azimuth_(std::move(azimuth)), Intensity_(std::move(intensity))
{
  this->Check(where);
  const double scale =
    glm::pi<double>() / IntensityTable::Flux(this->Polar_, this->Azimuth_, this->Intensity_);
  for (double& value : this->Intensity_)
  {
    value *= scale;
  }
  this->Largest_ = *std::max_element(this->Intensity_.begin(), this->Intensity_.end());
  const std::size_t count = this->Polar_.size();
  double steepest = 0.0;
  for (std::size_t plane = 0; plane < this->Azimuth_.size(); ++plane)
  {
    for (std::size_t i = 0; i + 1 < count; ++i)
    {
      const double* const values = &this->Intensity_[plane * count + i];
      const double step = (this->Polar_[i + 1] - this->Polar_[i]) * Degree;
      steepest = std::max(steepest, std::abs(values[1] - values[0]) / step);
      if (plane + 1 < this->Azimuth_.size())
      {
        const double around = (this->Azimuth_[plane + 1] - this->Azimuth_[plane]) * Degree *
                              std::sin(this->Polar_[i + 1] * Degree);
        steepest = std::max(steepest, std::abs(values[count + 1] - values[1]) / around);
      }
    }
  }
  this->Sharpness_ = steepest / this->Largest_;
}

void IntensityTable::Check(const std::string& where) const
{
  CheckAngles(this->Polar_, 90.0, "polar", where);
  if (this->Azimuth_.size() != 1)
  {
    CheckAngles(this->Azimuth_, 360.0, "azimuth", where);
  }
  if (this->Intensity_.size() != this->Polar_.size() * this->Azimuth_.size())
  {
    throw Error(where,
      "it holds " + std::to_string(this->Intensity_.size()) + " values for " +
        std::to_string(this->Azimuth_.size()) + " x " + std::to_string(this->Polar_.size()) +
        " angles",
      "Give one value a pair of angles");
  }
  bool shines = false;
  for (const double value : this->Intensity_)
  {
    if (!(value >= 0.0) || !std::isfinite(value))
    {
      throw Error(where, "the intensity " + std::to_string(value) + " is not allowed",
        "Intensities must be finite and not negative");
    }
    shines = shines || value > 0.0;
  }
  if (!shines)
  {
    throw Error(where, "all intensities are 0", "Leave a lamp without light out");
  }
}

double IntensityTable::Value(double x, double y, double z) const
{
  const double polar = std::acos(std::clamp(z, -1.0, 1.0)) / Degree;
  if (polar > 90.0)
  {
    return 0.0;
  }
  const auto [row, t] = Place(this->Polar_, polar);
  const std::size_t count = this->Polar_.size();
  const auto along = [&, first = row, share = t](std::size_t plane)
  {
    const double* const values = &this->Intensity_[plane * count + first];
    return (1.0 - share) * values[0] + share * values[1];
  };
  if (this->Azimuth_.size() == 1)
  {
    return along(0);
  }
  const double angle = std::atan2(y, x) / Degree;
  const auto [plane, s] = Place(this->Azimuth_, angle < 0.0 ? angle + 360.0 : angle);
  return (1.0 - s) * along(plane) + s * along(plane + 1);
}

} // namespace smokevis
