// Cuts a plate into trapezoids along the edges of a figure.
#include "PlateFigure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace smokevis
{
namespace
{

/// Heights that differ by less, as a share of the plate's, are one.
constexpr double SameHeight = 1e-7;

/// An edge of the figure, from its lower end to its upper.
struct Edge
{
  glm::dvec2 Low, High;
  /// +1 where the figure's polygon runs upwards along it, else -1.
  int Turn;

  double At(double y) const
  {
    return this->Low.x +
           (this->High.x - this->Low.x) * (y - this->Low.y) / (this->High.y - this->Low.y);
  }
};

double SignedArea(const FigurePolygon& polygon)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec2& a = polygon[i];
    const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

std::vector<Edge> EdgesOf(const std::vector<FigurePolygon>& figure)
{
  std::vector<Edge> edges;
  for (const FigurePolygon& polygon : figure)
  {
    // All run the same way round, or the overlap of two would cancel.
    const int side = SignedArea(polygon) < 0.0 ? -1 : 1;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const glm::dvec2& a = polygon[i];
      const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
      if (a.y < b.y)
      {
        edges.push_back({a, b, side});
      }
      else if (a.y > b.y)
      {
        edges.push_back({b, a, -side});
      }
    }
  }
  return edges;
}

/// Heights between which edges neither begin nor end nor cross.
std::vector<double> HeightsOf(const std::vector<Edge>& edges, double height, std::size_t rows)
{
  std::vector<double> heights;
  for (std::size_t row = 0; row <= rows; ++row)
  {
    heights.push_back(height * (static_cast<double>(row) / static_cast<double>(rows) - 0.5));
  }
  const auto add = [&heights, height](double y)
  {
    if (std::abs(y) < 0.5 * height)
    {
      heights.push_back(y);
    }
  };
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    add(edges[i].Low.y);
    add(edges[i].High.y);
    for (std::size_t j = 0; j < i; ++j)
    {
      const double low = std::max(edges[i].Low.y, edges[j].Low.y);
      const double high = std::min(edges[i].High.y, edges[j].High.y);
      if (low >= high)
      {
        continue;
      }
      const double below = edges[i].At(low) - edges[j].At(low);
      const double above = edges[i].At(high) - edges[j].At(high);
      if ((below < 0.0 && above > 0.0) || (below > 0.0 && above < 0.0))
      {
        add(low + (high - low) * below / (below - above));
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  std::vector<double> distinct = {heights.front()};
  for (const double y : heights)
  {
    if (y - distinct.back() > SameHeight * height)
    {
      distinct.push_back(y);
    }
  }
  distinct.back() = 0.5 * height;
  return distinct;
}

/// A trapezoid that may still grow upwards: its bounding edges, or -1 for the plate's.
struct Span
{
  int Left, Right;
  bool Figure;
  double Bottom;
};

/// Cuts one plate.
class Cutter
{
public:
  Cutter(const std::vector<FigurePolygon>& figure, double width, double height, std::size_t rows)
      : Edges_(EdgesOf(figure)), Width_(width), Height_(height), Rows_(rows)
  {
  }

  std::vector<FigureCell> Cut()
  {
    const std::vector<double> heights = HeightsOf(this->Edges_, this->Height_, this->Rows_);
    std::vector<Span> open;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i)
    {
      std::vector<Span> strip = this->StripOf(heights[i], heights[i + 1]);
      const bool sameRow =
        i > 0 && this->RowOf(heights[i - 1], heights[i]) == this->RowOf(heights[i], heights[i + 1]);
      for (const Span& below : open)
      {
        const auto same = std::find_if(strip.begin(), strip.end(),
          [&below](const Span& span) {
            return span.Left == below.Left && span.Right == below.Right &&
                   span.Figure == below.Figure;
          });
        if (sameRow && same != strip.end())
        {
          same->Bottom = below.Bottom;
        }
        else
        {
          this->Close(below, heights[i]);
        }
      }
      open = std::move(strip);
    }
    for (const Span& span : open)
    {
      this->Close(span, heights.back());
    }
    return std::move(this->Cells_);
  }

private:
  std::size_t RowOf(double low, double high) const
  {
    const double place = (0.5 * (low + high) / this->Height_ + 0.5) * this->Rows_;
    return std::min(this->Rows_ - 1, static_cast<std::size_t>(std::max(0.0, place)));
  }

  /// Where an edge is, no farther out than the plate.
  double At(int edge, double y, bool left) const
  {
    const double half = 0.5 * this->Width_;
    return edge < 0 ? (left ? -half : half) : std::clamp(this->Edges_[edge].At(y), -half, half);
  }

  std::vector<Span> StripOf(double low, double high) const
  {
    const double middle = 0.5 * (low + high);
    std::vector<std::pair<double, int>> crossed;
    for (std::size_t i = 0; i < this->Edges_.size(); ++i)
    {
      if (this->Edges_[i].Low.y<middle&& this->Edges_[i].High.y> middle)
      {
        crossed.emplace_back(this->Edges_[i].At(middle), static_cast<int>(i));
      }
    }
    std::sort(crossed.begin(), crossed.end());
    std::vector<Span> strip = {{-1, -1, false, low}};
    int winding = 0;
    for (const auto& [x, edge] : crossed)
    {
      const bool before = winding != 0;
      winding += this->Edges_[edge].Turn;
      if (before != (winding != 0))
      {
        strip.back().Right = edge;
        strip.push_back({edge, -1, winding != 0, low});
      }
    }
    return strip;
  }

  void Close(const Span& span, double top)
  {
    const double y[2] = {span.Bottom, top};
    std::array<glm::dvec2, 4> corners;
    for (int i = 0; i < 2; ++i)
    {
      const double left = this->At(span.Left, y[i], true);
      const double right = std::max(left, this->At(span.Right, y[i], false));
      corners[i == 0 ? 0 : 3] = {left, y[i]};
      corners[i == 0 ? 1 : 2] = {right, y[i]};
    }
    const double least = 1e-9 * this->Width_;
    FigureCell cell;
    cell.Figure = span.Figure;
    cell.Row = this->RowOf(span.Bottom, top);
    for (std::size_t i = 0; i < 4; ++i)
    {
      if (glm::length(corners[i] - corners[(i + 1) % 4]) > least)
      {
        cell.Corners.push_back(corners[i]);
      }
    }
    if (cell.Corners.size() > 2 && SignedArea(cell.Corners) > 1e-11 * this->Width_ * this->Height_)
    {
      this->Cells_.push_back(std::move(cell));
    }
  }

  std::vector<Edge> Edges_;
  double Width_, Height_;
  std::size_t Rows_;
  std::vector<FigureCell> Cells_;
};

} // namespace

//------------------------------------------------------------------------------
std::vector<FigureCell> CutFigure(
  const std::vector<FigurePolygon>& figure, double width, double height, std::size_t rows)
{
  return Cutter(figure, width, height, rows).Cut();
}

//------------------------------------------------------------------------------
std::vector<FigurePolygon> Stroke(const std::vector<glm::dvec2>& points, double thickness)
{
  const std::size_t segments = points.size() - 1;
  const bool closed = points.front() == points.back();
  const double half = 0.5 * thickness;
  const auto direction = [&](std::size_t segment)
  { return glm::normalize(points[segment + 1] - points[segment]); };
  const auto across = [](const glm::dvec2& along) { return glm::dvec2(-along.y, along.x); };
  // From the line to its left border at a corner between two segments.
  const auto mitre = [&](std::size_t before, std::size_t after)
  {
    const glm::dvec2 sum = across(direction(before)) + across(direction(after));
    return 2.0 * half / glm::dot(sum, sum) * sum;
  };
  std::vector<FigurePolygon> outline;
  for (std::size_t i = 0; i < segments; ++i)
  {
    const glm::dvec2 along = direction(i);
    glm::dvec2 start = points[i];
    glm::dvec2 end = points[i + 1];
    glm::dvec2 atStart = half * across(along);
    glm::dvec2 atEnd = atStart;
    if (i > 0 || closed)
    {
      atStart = mitre(i > 0 ? i - 1 : segments - 1, i);
    }
    else
    {
      start -= half * along;
    }
    if (i + 1 < segments || closed)
    {
      atEnd = mitre(i, i + 1 < segments ? i + 1 : 0);
    }
    else
    {
      end += half * along;
    }
    outline.push_back({start - atStart, end - atEnd, end + atEnd, start + atStart});
  }
  return outline;
}

} // namespace smokevis
