#include "ResponseCurve.h"

#include "Errors.h"
#include "TextFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace smokevis
{
namespace
{

constexpr double LargestValue = 255.0;

/// sRGB's encoding of a share of light, 0 to 1 (IEC 61966-2-1).
double Encode(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

/// The inverse of Encode.
double Decode(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Exposure at ISO 100 of which 1/e of the film is left unexposed [lx s].
double FilmExposure()
{
  // ISO 12232: value 118 at 10 lx s over the speed.
  static const double exposure = -0.1 / std::log(1.0 - Decode(118.0 / LargestValue));
  return exposure;
}

std::string Trim(const std::string& text)
{
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

double Number(const std::string& text, const std::string& where)
{
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || rest != end || !std::isfinite(value))
  {
    throw Error(where, "'" + text + "' is not a number",
      "Give an exposure [lx s], a comma, and a pixel value from 0 to 255");
  }
  return value;
}

} // namespace

//------------------------------------------------------------------------------
ResponseCurve ResponseCurve::Read(const std::string& fileName)
{
  const std::string name = "response curve '" + fileName + "'";
  std::istringstream file(
    ReadTextFile(name, fileName, "Give a CSV file with the header exposure,pixel_value"));
  ResponseCurve curve;
  bool header = false;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    line = Trim(line);
    if (line.empty() || line[0] == '#')
    {
      continue;
    }
    const std::string where = name + ", line " + std::to_string(number);
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos || line.find(',', comma + 1) != std::string::npos)
    {
      throw Error(where, "there are not two fields", "Give an exposure, a comma and a pixel value");
    }
    const std::string first = Trim(line.substr(0, comma));
    const std::string second = Trim(line.substr(comma + 1));
    if (!header)
    {
      if (first != "exposure" || second != "pixel_value")
      {
        throw Error(where, "the header is '" + line + "'", "Let it be exposure,pixel_value");
      }
      header = true;
      continue;
    }
    const Point point{Number(first, where), Number(second, where)};
    if (point.Exposure < 0.0 || point.Value < 0.0 || point.Value > LargestValue)
    {
      throw Error(where, "the exposure is negative or the pixel value not from 0 to 255",
        "Give exposures in lx s at ISO 100 and values of 8 bits");
    }
    if (!curve.Points_.empty() && (point.Exposure <= curve.Points_.back().Exposure ||
                                    point.Value < curve.Points_.back().Value))
    {
      throw Error(where, "the exposure does not rise or the pixel value falls",
        "Sort the points by exposure; more light never makes a darker pixel");
    }
    curve.Points_.push_back(point);
  }
  if (curve.Points_.size() < 2)
  {
    throw Error(name, "it holds fewer than two points", "Give at least two lines below the header");
  }
  return curve;
}

//------------------------------------------------------------------------------
double ResponseCurve::Value(double exposure) const
{
  if (this->Points_.empty())
  {
    return LargestValue * Encode(-std::expm1(-std::max(0.0, exposure) / FilmExposure()));
  }
  const auto above = std::upper_bound(this->Points_.begin(), this->Points_.end(), exposure,
    [](double value, const Point& point) { return value < point.Exposure; });
  if (above == this->Points_.begin())
  {
    return above->Value;
  }
  const Point& low = *(above - 1);
  if (above == this->Points_.end())
  {
    return low.Value;
  }
  const double part = low.Exposure > 0.0 ? std::log(exposure / low.Exposure) /
                                             std::log(above->Exposure / low.Exposure)
                                         : exposure / above->Exposure;
  return low.Value + part * (above->Value - low.Value);
}

} // namespace smokevis
