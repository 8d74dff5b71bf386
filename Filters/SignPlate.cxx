// Cuts the plate of an exit sign into lit and unlit cells.
#include "SignPlate.h"

#include "Errors.h"
#include "PropertyChecks.h"
#include "SignFigures.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{
namespace
{

constexpr int MaximumBars = 9999;
/// Rows that a plate whose luminance falls from top to bottom is cut into.
constexpr std::size_t UnevenRows = 16;
/// Share of the plate's height and of its width that figures of no given height fill at most.
constexpr double FilledHeight = 0.7;
constexpr double FilledWidth = 0.9;

/// So many strips of equal width, centred on 0.
std::vector<double> Strips(double size, std::size_t count)
{
  std::vector<double> lines(count + 1);
  for (std::size_t i = 0; i <= count; ++i)
  {
    lines[i] = size * (static_cast<double>(i) / static_cast<double>(count) - 0.5);
  }
  return lines;
}

/// Bars and gaps in turn, a bar at both ends where their number is odd.
std::vector<double> BarLines(const SignPlate& sign)
{
  const int bars = (sign.Bars + 1) / 2;
  const int gaps = sign.Bars - bars;
  const double unit = sign.Width / (bars * sign.BarFraction + gaps * (1.0 - sign.BarFraction));
  std::vector<double> lines = {-0.5 * sign.Width};
  for (int i = 0; i < sign.Bars; ++i)
  {
    const double share = i % 2 == 0 ? sign.BarFraction : 1.0 - sign.BarFraction;
    lines.push_back(lines.back() + unit * share);
  }
  lines.back() = 0.5 * sign.Width;
  return lines;
}

void CheckSign(const SignPlate& sign, const std::string& name)
{
  Check(IsPositive(sign.Width) && IsPositive(sign.Height), name,
    "its width or height is not a positive length", "Give both in metres");
  Check(sign.Id >= 0, name, "its id is negative", "Give an id from 0; -1 stands for lamps");
  Check(sign.Uniformity > 0.0 && sign.Uniformity <= 1.0, name, "its uniformity is outside 0 to 1",
    "Give the least over the greatest luminance, such as 0.1, or 1 for an even plate");
  Check(IsNotNegative(sign.EmissionExponent), name,
    "its emission exponent is negative or not finite", "Give 0 for a diffuse plate");
  Check(IsNotNegative(sign.FigureHeight), name, "its figure height is negative or not finite",
    "Give metres, or 0 for as large as fits");
  if (sign.Pattern == SignPattern::Barcode)
  {
    Check(sign.Bars >= 1 && sign.Bars <= MaximumBars, name,
      "its number of bars is outside 1 to " + std::to_string(MaximumBars),
      "Give an odd number, such as 9");
    Check(sign.BarFraction > 0.0 && sign.BarFraction < 1.0, name,
      "its bar fraction is not between 0 and 1",
      "Give the width of a bar over that of a bar and a gap");
  }
  Check(sign.Pattern != SignPattern::Square ||
          (sign.SquareFraction > 0.0 && sign.SquareFraction <= 1.0),
    name, "its square fraction is outside 0 to 1",
    "Give the side of the lit square over the plate's shorter side");
}

/// How the parts of one sign look.
class SignLooks
{
public:
  SignLooks(const SignPlate& sign, const std::string& name) : Sign_(sign)
  {
    const double* unlit = sign.UnlitColour;
    if (unlit[0] == 0.0 && unlit[1] == 0.0 && unlit[2] == 0.0)
    {
      unlit = sign.Colour;
    }
    this->Lit_.Luminance = ColouredLuminance(sign.Luminance, sign.Colour, name);
    this->Lit_.Reflectance = ColouredReflectance(sign.Reflectance, sign.Colour, name);
    this->Unlit_.Luminance = ColouredLuminance(sign.UnlitLuminance, unlit, name);
    this->Unlit_.Reflectance = ColouredReflectance(
      sign.UnlitReflectance < 0.0 ? sign.Reflectance : sign.UnlitReflectance, unlit, name);
  }

  /// @param figure share of the figure in the cell, 0 to 1
  /// @param middle height of the cell's centre over that of the plate's [m]
  CellLook Get(double figure, double middle) const
  {
    const double lit = this->Sign_.Design == SignDesign::Stencil ? figure : 1.0 - figure;
    // Linear from bottom to top, as where a lamp shines into the plate's upper edge; 1 on average.
    const double place = std::clamp(middle / this->Sign_.Height + 0.5, 0.0, 1.0);
    const double even =
      2.0 / (1.0 + this->Sign_.Uniformity) * glm::mix(this->Sign_.Uniformity, 1.0, place);
    CellLook look;
    look.Lit = lit > 0.5;
    for (int band = 0; band < MaxBands; ++band)
    {
      look.Luminance[band] =
        even * glm::mix(this->Unlit_.Luminance[band], this->Lit_.Luminance[band], lit);
      look.Reflectance[band] =
        glm::mix(this->Unlit_.Reflectance[band], this->Lit_.Reflectance[band], lit);
    }
    return look;
  }

private:
  const SignPlate& Sign_;
  CellLook Lit_, Unlit_;
};

/// Rectangles of pixels of one grey level: runs along rows, joined where rows repeat them.
std::vector<PlateMesh::PlateCell> ImageCells(
  const SignPlate& sign, const SignLooks& looks, std::size_t rows)
{
  struct Run
  {
    int First, Last;
    double Grey;
    int Bottom;
  };
  const Stencil stencil = Stencil::Read(sign.PatternFile);
  std::vector<PlateMesh::PlateCell> cells;
  std::vector<Run> open;
  const auto at = [&](double column, double row)
  {
    return glm::dvec2(
      sign.Width * (column / stencil.Width - 0.5), sign.Height * (row / stencil.Height - 0.5));
  };
  const auto close = [&](const Run& run, int top)
  {
    // An uneven plate is cut along its rows as well.
    const double low = static_cast<double>(run.Bottom) / stencil.Height * rows;
    const double high = static_cast<double>(top) / stencil.Height * rows;
    for (double from = low; from < high - 1e-9;)
    {
      const double to = std::min(high, std::floor(from + 1.0 + 1e-9));
      const double bottom = from / rows * stencil.Height;
      const double above = to / rows * stencil.Height;
      cells.push_back(
        {{at(run.First, bottom), at(run.Last, bottom), at(run.Last, above), at(run.First, above)},
          looks.Get(run.Grey, 0.5 * (at(0, bottom).y + at(0, above).y))});
      from = to;
    }
  };
  for (int row = 0; row < stencil.Height; ++row)
  {
    std::vector<Run> runs;
    for (int column = 0; column < stencil.Width; ++column)
    {
      const double grey = stencil.Grey[column + static_cast<std::size_t>(row) * stencil.Width];
      if (!runs.empty() && runs.back().Grey == grey)
      {
        runs.back().Last = column + 1;
      }
      else
      {
        runs.push_back({column, column + 1, grey, row});
      }
    }
    for (const Run& below : open)
    {
      const auto same = std::find_if(runs.begin(), runs.end(),
        [&below](const Run& run)
        { return run.First == below.First && run.Last == below.Last && run.Grey == below.Grey; });
      if (same != runs.end())
      {
        same->Bottom = below.Bottom;
      }
      else
      {
        close(below, row);
      }
    }
    open = std::move(runs);
  }
  for (const Run& run : open)
  {
    close(run, stencil.Height);
  }
  return cells;
}

/// Cells of letters or a pictogram in the middle of the plate.
std::vector<PlateMesh::PlateCell> FigureCells(const SignPlate& sign, const SignLooks& looks,
  std::size_t rows, const SignFigure& figure, const std::string& name)
{
  double scale = sign.FigureHeight / figure.Height;
  if (scale == 0.0)
  {
    scale =
      std::min(FilledHeight * sign.Height / figure.Height, FilledWidth * sign.Width / figure.Width);
  }
  if (scale * figure.Width > sign.Width || scale * figure.Height > sign.Height)
  {
    throw Error(name,
      "its figure of " + std::to_string(scale * figure.Width) + " x " +
        std::to_string(scale * figure.Height) + " m is larger than the plate",
      "Give a smaller figure height, or 0 for as large as fits");
  }
  std::vector<FigurePolygon> polygons = figure.Polygons;
  for (FigurePolygon& polygon : polygons)
  {
    for (glm::dvec2& corner : polygon)
    {
      corner = scale * (corner - 0.5 * glm::dvec2(figure.Width, figure.Height));
    }
  }
  std::vector<PlateMesh::PlateCell> cells;
  for (const FigureCell& cell : CutFigure(polygons, sign.Width, sign.Height, rows))
  {
    const double row = sign.Height * ((cell.Row + 0.5) / rows - 0.5);
    cells.push_back({cell.Corners, looks.Get(cell.Figure ? 1.0 : 0.0, row)});
  }
  return cells;
}

} // namespace

//------------------------------------------------------------------------------
void AddSign(const SignPlate& sign, PlateMesh& mesh)
{
  const std::string name = (sign.Origin.empty() ? "" : sign.Origin + ", ") + "sign " +
                           std::to_string(sign.Id) +
                           (sign.Name.empty() ? "" : " (" + sign.Name + ")");
  CheckSign(sign, name);
  const SignLooks looks(sign, name);
  const PlateMesh::Plate plate{PlateFrame::Make(sign.Centre, sign.Normal, sign.Up, name), sign.Id,
    sign.Name.empty() ? "Sign " + std::to_string(sign.Id) : sign.Name, sign.EmissionExponent};
  const std::size_t rows = sign.Uniformity < 1.0 ? UnevenRows : 1;

  switch (sign.Pattern)
  {
  case SignPattern::Square:
  {
    const double half = 0.5 * sign.SquareFraction * std::min(sign.Width, sign.Height);
    std::vector<double> lines = Strips(sign.Height, rows);
    lines.insert(lines.end(), {-half, half});
    std::sort(lines.begin(), lines.end());
    mesh.Add(plate, {-0.5 * sign.Width, -half, half, 0.5 * sign.Width}, lines,
      [&](std::size_t i, std::size_t j)
      {
        const double middle = 0.5 * (lines[j] + lines[j + 1]);
        return looks.Get(i == 1 && std::abs(middle) < half ? 1.0 : 0.0, middle);
      });
    break;
  }
  case SignPattern::Barcode:
  {
    const std::vector<double> lines = Strips(sign.Height, rows);
    mesh.Add(plate, BarLines(sign), lines,
      [&](std::size_t i, std::size_t j)
      { return looks.Get(i % 2 == 0 ? 1.0 : 0.0, 0.5 * (lines[j] + lines[j + 1])); });
    break;
  }
  case SignPattern::Image:
    mesh.Add(plate, ImageCells(sign, looks, rows));
    break;
  case SignPattern::Text:
    mesh.Add(plate, FigureCells(sign, looks, rows, TextFigure(sign.Text, name), name));
    break;
  case SignPattern::RunningMan:
    mesh.Add(plate, FigureCells(sign, looks, rows, RunningManFigure(), name));
    break;
  }
}

} // namespace smokevis
