#include "BlackBody.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace smokevis
{

namespace
{

// CODATA: h c / k [m K] and 2 h c^2 [W m2], and the luminous efficacy of 540 THz [lm/W].
constexpr double SecondRadiation = 1.438776877e-2;
constexpr double FirstRadiance = 1.191042972e-16;
constexpr double MaximumEfficacy = 683.002;
constexpr double Kelvin = 273.15;
constexpr double Coldest = 500.0;
constexpr double Hottest = 5000.0;
// The logarithm of the luminance is close to linear in 1/T; steps of that [1/K].
constexpr int Steps = 512;

double Lobe(double x, double height, double centre, double below, double above)
{
  const double t = (x - centre) * (x < centre ? below : above);
  return height * std::exp(-0.5 * t * t);
}

// V at a wavelength [nm].
double Photopic(double wavelength)
{
  return Lobe(wavelength, 0.821, 568.8, 0.0213, 0.0247) +
         Lobe(wavelength, 0.286, 530.9, 0.0613, 0.0322);
}

double Integrate(double kelvin)
{
  double sum = 0.0;
  for (int nanometre = 360; nanometre <= 830; ++nanometre)
  {
    const double wavelength = 1e-9 * nanometre;
    sum += Photopic(nanometre) * FirstRadiance / std::pow(wavelength, 5) /
           std::expm1(SecondRadiation / (wavelength * kelvin));
  }
  return MaximumEfficacy * sum * 1e-9;
}

struct Table
{
  Table()
  {
    for (int i = 0; i <= Steps; ++i)
    {
      const double inverse = First + i * Step;
      LogLuminance[i] = std::log(Integrate(1.0 / inverse));
    }
  }

  static constexpr double First = 1.0 / (Hottest + Kelvin);
  static constexpr double Step = (1.0 / (Coldest + Kelvin) - First) / Steps;
  std::array<double, Steps + 1> LogLuminance{};
};

} // namespace

//------------------------------------------------------------------------------------------------
double BlackBodyLuminance(double celsius)
{
  static const Table table;
  if (!(celsius >= Coldest))
  {
    return 0.0;
  }
  const double inverse = 1.0 / (std::min(celsius, Hottest) + Kelvin);
  const double place = std::clamp((inverse - Table::First) / Table::Step, 0.0, Steps - 1e-9);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  return std::exp((1.0 - part) * table.LogLuminance[below] + part * table.LogLuminance[below + 1]);
}

} // namespace smokevis
