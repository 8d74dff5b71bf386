// Cuts the plate of an exit sign into lit and unlit cells.
#include "SignPlate.h"

#include "Errors.h"

#include <cmath>

namespace smokevis
{
namespace
{

constexpr int MaximumBars = 9999;

/// So many strips of equal width, centred on 0.
std::vector<double> Strips(double size, int count)
{
  std::vector<double> lines(count + 1);
  for (int i = 0; i <= count; ++i)
  {
    lines[i] = size * (static_cast<double>(i) / count - 0.5);
  }
  return lines;
}

void CheckSign(const SignPlate& sign, const std::string& name)
{
  const auto length = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!length(sign.Width) || !length(sign.Height))
  {
    throw Error(name, "its width or height is not a positive length", "Give both in metres");
  }
  if (sign.Id < 0)
  {
    throw Error(name, "its id is negative", "Give an id from 0; -1 stands for lamps");
  }
  if (!(sign.Reflectance >= 0.0 && sign.Reflectance <= 1.0))
  {
    throw Error(name, "its reflectance is outside 0 to 1", "Give a diffuse reflectance");
  }
  if (sign.Pattern == SignPattern::Barcode && (sign.Bars < 1 || sign.Bars > MaximumBars))
  {
    throw Error(name, "its number of bars is outside 1 to " + std::to_string(MaximumBars),
      "Give an odd number, such as 9");
  }
  if (sign.Pattern == SignPattern::Square &&
      !(sign.SquareFraction > 0.0 && sign.SquareFraction <= 1.0))
  {
    throw Error(name, "its square fraction is outside 0 to 1",
      "Give the side of the lit square over the plate's shorter side");
  }
}

} // namespace

//------------------------------------------------------------------------------
void AddSign(const SignPlate& sign, PlateMesh& mesh)
{
  const std::string name = (sign.Origin.empty() ? "" : sign.Origin + ", ") + "sign " +
                           std::to_string(sign.Id) +
                           (sign.Name.empty() ? "" : " (" + sign.Name + ")");
  CheckSign(sign, name);
  const Spectrum lit = ColouredLuminance(sign.Luminance, sign.Colour, name);
  const Spectrum unlit = ColouredLuminance(sign.UnlitLuminance, sign.Colour, name);
  const PlateMesh::Plate plate{PlateFrame::Make(sign.Centre, sign.Normal, sign.Up, name), sign.Id,
    sign.Name.empty() ? "Sign " + std::to_string(sign.Id) : sign.Name, sign.Reflectance};

  switch (sign.Pattern)
  {
  case SignPattern::Square:
  {
    const double half = 0.5 * sign.SquareFraction * std::min(sign.Width, sign.Height);
    mesh.Add(plate, {-0.5 * sign.Width, -half, half, 0.5 * sign.Width},
      {-0.5 * sign.Height, -half, half, 0.5 * sign.Height},
      [&](std::size_t i, std::size_t j) { return i == 1 && j == 1 ? lit : unlit; });
    break;
  }
  case SignPattern::Barcode:
    mesh.Add(plate, Strips(sign.Width, sign.Bars), Strips(sign.Height, 1),
      [&](std::size_t i, std::size_t) { return i % 2 == 0 ? lit : unlit; });
    break;
  case SignPattern::Image:
  {
    const Stencil stencil = Stencil::Read(sign.PatternFile);
    mesh.Add(plate, Strips(sign.Width, stencil.Width), Strips(sign.Height, stencil.Height),
      [&](std::size_t i, std::size_t j)
      {
        const double grey = stencil.Grey[i + j * stencil.Width];
        Spectrum luminance;
        for (int band = 0; band < MaxBands; ++band)
        {
          luminance[band] = unlit[band] + grey * (lit[band] - unlit[band]);
        }
        return luminance;
      });
    break;
  }
  }
}

} // namespace smokevis
