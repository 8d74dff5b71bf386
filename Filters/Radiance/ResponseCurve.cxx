#include "ResponseCurve.h"

#include "Errors.h"
#include "Srgb.h"
#include "TextLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace smokevis
{
namespace
{

constexpr double LargestValue = 255.0;

/// Exposure at ISO 100 of which 1/e of the film is left unexposed [lx s].
double FilmExposure()
{
  // ISO 12232: value 118 at 10 lx s over the speed.
  static const double exposure = -0.1 / std::log(1.0 - DecodeSrgb(118.0 / LargestValue));
  return exposure;
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
  ResponseCurve curve;
  bool header = false;
  for (const auto& [number, line] :
    ReadTableLines(name, fileName, "Give a CSV file with the header exposure,pixel_value"))
  {
    const std::string where = name + ", line " + std::to_string(number);
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos || line.find(',', comma + 1) != std::string::npos)
    {
      throw Error(where, "there are not two fields", "Give an exposure, a comma and a pixel value");
    }
    const std::string first = Trimmed(line.substr(0, comma));
    const std::string second = Trimmed(line.substr(comma + 1));
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
    return LargestValue * EncodeSrgb(-std::expm1(-std::max(0.0, exposure) / FilmExposure()));
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
