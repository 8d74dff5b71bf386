#include "Photograph.h"

#include "Sampler.h"
#include "Types.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{
namespace
{

/// q of ISO 12232.
constexpr double LensFactor = 0.65;
/// K of ISO 2720 [cd s/m2].
constexpr double MeterConstant = 12.5;
constexpr double ShortestTime = 1.0 / 8000.0;
constexpr double LongestTime = 30.0;
/// Exposure times speed that saturates a sensor [lx s], ISO 12232.
constexpr double Saturation = 78.0;

/// A number of the standard normal distribution from a counter (Box and Muller).
double Normal(std::uint64_t seed, std::uint64_t index)
{
  const double radius = 1.0 - ToUnit(Mix(Mix(seed) + 2 * index));
  const double angle = 2.0 * 3.141592653589793 * ToUnit(Mix(Mix(seed) + 2 * index + 1));
  return std::sqrt(-2.0 * std::log(radius)) * std::cos(angle);
}

} // namespace

//------------------------------------------------------------------------------
double SensorIlluminance(double luminance, const ExposureSettings& settings)
{
  const double stop = settings.FNumber * (1.0 + settings.Magnification);
  return LensFactor * luminance / (stop * stop);
}

//------------------------------------------------------------------------------
double FocalPlaneExposure(double luminance, const ExposureSettings& settings, double time)
{
  return SensorIlluminance(luminance, settings) * time;
}

//------------------------------------------------------------------------------
double MeteredTime(double meanLuminance, const ExposureSettings& settings)
{
  const double stop = settings.FNumber * (1.0 + settings.Magnification);
  const double time = MeterConstant * stop * stop / (meanLuminance * settings.Iso);
  return meanLuminance > 0.0 ? std::clamp(time, ShortestTime, LongestTime) : LongestTime;
}

//------------------------------------------------------------------------------
Photograph TakePhotograph(const std::vector<float>& luminance, int components,
  const ExposureSettings& settings, const ResponseCurve& curve)
{
  Photograph photograph;
  photograph.Time = settings.Time;
  if (!(settings.Time > 0.0))
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < luminance.size(); ++i)
    {
      sum += (components == 1 ? 1.0 : PhotopicWeights[i % 3]) * luminance[i];
    }
    photograph.Time =
      MeteredTime(sum * components / static_cast<double>(luminance.size()), settings);
  }
  photograph.Values.resize(luminance.size());
  const double sensitivity = settings.Iso / 100.0;
  for (std::size_t i = 0; i < luminance.size(); ++i)
  {
    double exposure = FocalPlaneExposure(luminance[i], settings, photograph.Time);
    if (settings.ReadNoise > 0.0)
    {
      exposure += settings.ReadNoise * Saturation / settings.Iso * Normal(settings.Seed, i);
    }
    photograph.Values[i] =
      static_cast<std::uint8_t>(std::lround(curve.Value(sensitivity * exposure)));
  }
  return photograph;
}

} // namespace smokevis
