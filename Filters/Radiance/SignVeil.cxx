#include "SignVeil.h"

#include "GaussNodes.h"
#include "Roughness.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace smokevis
{

namespace
{

/// Errors of sixteen batches are known to a fifth: what is gathered is clearly better where its
/// error is below this share of the other.
constexpr double BetterShare = 0.7;
/// Tolerances of the shapes before a plate at which smoke is right before it.
constexpr double NearlyOnPlate = 10.0;
/// Cosine of the slant beyond which the way of an eye's rays close to a plate gets no longer.
constexpr double LeastSlant = 0.25;
/// Share of the veil before the plate's middle by which it may bend along either edge between the
/// ways that tell it, for the others to be told by these.
constexpr double EvenShare = 0.005;
/// Of the three by three ways: the middle one, those to the corners, and one that tells how the
/// veil bends along an edge; from them those between corners of one edge and of the other can be
/// told.
constexpr std::size_t Middle = 4;
constexpr std::array<std::size_t, 4> Corners = {0, 2, 6, 8};
constexpr std::size_t Below = 1;
struct ToldWay
{
  std::size_t Way, From, To;
};
constexpr ToldWay Above = {7, 6, 8};
constexpr std::array<ToldWay, 2> Beside = {{{3, 0, 6}, {5, 2, 8}}};

/// Columns of more than this share of an edge, which is not that of even columns, are divided where
/// the smoke right before them changes by more than this share, into parts no smaller than these.
constexpr double WideColumn = 0.225;
constexpr double LeastJump = 0.2;
constexpr double SmallestPart = 0.01;

/// Up to this tolerance columns and rows are halved, while there are no more parts of the pattern:
/// what glows close to it falls off towards the ends of bars, and changes most beside their edges.
constexpr double FineTolerance = 0.05;
constexpr std::size_t MostParts = 32;

/// The batches of all that the smoke adds along a ray [cd/m2].
Lanes VeilOf(const RayLight& light)
{
  Lanes veil = light.VeilMultiple;
  for (float& value : veil.Value)
  {
    value += static_cast<float>(light.VeilDirect);
  }
  return veil;
}

/// From the sign's rectangle to a place: facets may lie before or behind it.
Vec3 OffPlate(const Sign& sign, const SeenPlace& place)
{
  return place.Point - OnPlate(sign, place.OnPlate.x, place.OnPlate.y);
}

/// Distance from a plate along a ray within which smoke glows in the shape of its pattern.
double GlowReach(
  const Sign& sign, const PlateColumns& columns, const PlateColumns& rows, const Vec3& direction)
{
  // The pattern blurs over a distance of about its period; aslant, rays are as close for longer.
  const double height =
    2.0 * std::min(columns.Widest * glm::length(sign.Corners[1] - sign.Corners[0]),
            rows.Widest * glm::length(sign.Corners[3] - sign.Corners[0]));
  return height / std::max(LeastSlant, std::abs(glm::dot(direction, sign.Normal)));
}

} // namespace

PlateAxis::PlateAxis(const View& view, const Sign& sign, const PlateColumns& pattern, int edge)
    : Pattern(pattern), Divided(pattern)
{
  const Scene& scene = view.TheScene();
  // A face of cells may go right through the middle.
  constexpr double middle = 0.513;
  const Vec3 first = edge == 0 ? OnPlate(sign, 0.0, middle) : OnPlate(sign, middle, 0.0);
  const Vec3 way = (edge == 0 ? OnPlate(sign, 1.0, middle) : OnPlate(sign, middle, 1.0)) - first;
  const double length = glm::length(way);
  std::vector<Segment> cells;
  scene.Smoke().Walk(first + NearlyOnPlate * scene.Shapes().Tolerance() * sign.Normal, way / length,
    0.0, length, cells);
  std::vector<double> borders;
  for (std::size_t next = 1; next < cells.size(); ++next)
  {
    const double one = scene.Smoke().Extinction(cells[next - 1].Cell);
    const double other = scene.Smoke().Extinction(cells[next].Cell);
    const double at = cells[next].Begin / length;
    const std::size_t column = pattern.Of(at);
    const double end = pattern.Ends[column + 1];
    const double begin = std::max(pattern.Ends[column], borders.empty() ? 0.0 : borders.back());
    if (std::abs(one - other) > LeastJump * std::max(one, other) &&
        end - pattern.Ends[column] > WideColumn && at > begin + SmallestPart &&
        at < end - SmallestPart)
    {
      borders.push_back(at);
    }
  }
  this->Divided = pattern.DividedAt(borders);
}

std::size_t SignVeil::Gather()
{
  std::vector<SightLine> lines;
  Lanes known;
  for (const Way& way : this->Ways_)
  {
    lines.push_back(way.Line);
    Add(known, way.Light.VeilMultiple, static_cast<float>(way.Line.Weight));
  }
  const GatheredVeil gathered = this->View_.GatherVeil(this->Eye_, lines, this->Band_);
  if (StandardError(gathered.Multiple) < BetterShare * StandardError(known))
  {
    for (Way& way : this->Ways_)
    {
      Add(way.Light.VeilMultiple, gathered.Multiple, 1.0F);
      Add(way.Light.VeilMultiple, known, -1.0F);
    }
  }
  return gathered.Rays;
}

PlateVeil::PlateVeil(const View& view, const Vec3& eye, int band,
  const std::vector<SeenPlace>& places, const Sign& sign, const PlateColumns& columns,
  const PlateColumns& rows)
    : SignVeil(view, eye, band, places), Columns_(columns), Rows_(rows)
{
  const auto reachOf = [&](const Vec3& direction)
  { return GlowReach(sign, columns, rows, direction); };
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 to = OnPlate(sign, Nodes3[i], Nodes3[j]) - eye;
      const double distance = glm::length(to);
      const Vec3 direction = to / distance;
      const double end = std::max(0.0, distance - reachOf(direction));
      this->Ways_.push_back({{direction, end, Weights3[i] * Weights3[j]}, {}});
    }
  }
  const auto trace = [this](std::size_t way)
  {
    const SightLine& line = this->Ways_[way].Line;
    this->Ways_[way].Light = this->Trace(line.Direction, 0.0, line.End);
  };
  for (const std::size_t way : {Middle, Corners[0], Corners[1], Corners[2], Corners[3], Below})
  {
    trace(way);
  }
  if (!this->TellRest())
  {
    for (const std::size_t way : {Above.Way, Beside[0].Way, Beside[1].Way})
    {
      trace(way);
    }
  }
  double ahead = std::numeric_limits<double>::infinity();
  for (const Way& way : this->Ways_)
  {
    ahead = std::min(ahead, way.Light.Veil());
  }
  if (view.Field().Tolerance <= FineTolerance)
  {
    this->Halve(sign);
  }
  this->Near_.resize(this->Columns_.Count() * this->Rows_.Count());
  for (std::size_t row = 0; row < this->Rows_.Count(); ++row)
  {
    for (std::size_t column = 0; column < this->Columns_.Count(); ++column)
    {
      for (std::size_t node = 0; node < Nodes; ++node)
      {
        const Vec3 to =
          OnPlate(sign, this->Columns_.Node(column, node % 2), this->Rows_.Node(row, node / 2)) -
          eye;
        const double distance = glm::length(to);
        const Vec3 direction = to / distance;
        const RayLight light =
          this->Trace(direction, std::max(0.0, distance - reachOf(direction)), distance, ahead);
        this->Near_[row * this->Columns_.Count() + column][node] = VeilOf(light);
      }
    }
  }
}

void PlateVeil::Halve(const Sign& sign)
{
  const double across = this->Columns_.Widest * glm::length(sign.Corners[1] - sign.Corners[0]);
  const double up = this->Rows_.Widest * glm::length(sign.Corners[3] - sign.Corners[0]);
  PlateColumns& longer = across > up ? this->Columns_ : this->Rows_;
  PlateColumns& other = across > up ? this->Rows_ : this->Columns_;
  for (PlateColumns* const parts : {&longer, &other})
  {
    if (2 * this->Columns_.Count() * this->Rows_.Count() <= MostParts)
    {
      *parts = parts->Halved();
    }
  }
}

bool PlateVeil::TellRest()
{
  const auto add = [this](RayLight& sum, std::size_t way, float weight)
  {
    const RayLight& light = this->Ways_[way].Light;
    sum.VeilDirect += weight * light.VeilDirect;
    Add(sum.VeilMultiple, light.VeilMultiple, weight);
  };
  // By how much the veil is more halfway along an edge than the mean of its ends, of the one edge
  // and of the other.
  RayLight across;
  add(across, Below, 1.0F);
  add(across, Corners[0], -0.5F);
  add(across, Corners[1], -0.5F);
  RayLight along;
  add(along, Middle, 1.0F);
  for (const std::size_t corner : Corners)
  {
    add(along, corner, -0.25F);
  }
  along.VeilDirect -= across.VeilDirect;
  Add(along.VeilMultiple, across.VeilMultiple, -1.0F);
  const auto size = [](const RayLight& light)
  { return light.VeilDirect + Mean(light.VeilMultiple); };
  const double most = EvenShare * size(this->Ways_[Middle].Light);
  if (!(std::max(std::abs(size(across)), std::abs(size(along))) <= most))
  {
    return false;
  }
  const auto tell = [&](const ToldWay& told, const RayLight& bend)
  {
    RayLight& light = this->Ways_[told.Way].Light;
    light = bend;
    add(light, told.From, 0.5F);
    add(light, told.To, 0.5F);
  };
  tell(Above, across);
  tell(Beside[0], along);
  tell(Beside[1], along);
  return true;
}

double PlateVeil::RelativeRoughness() const
{
  std::vector<SeenPlace> places;
  std::vector<double> veils;
  double mean = 0.0;
  for (std::size_t way = 0; way < this->Ways_.size(); ++way)
  {
    SeenPlace& place = places.emplace_back();
    place.OnPlate = {Nodes3[way % 3], Nodes3[way / 3]};
    place.Weight = this->Ways_[way].Line.Weight;
    veils.push_back(this->Ways_[way].Light.Veil());
    mean += place.Weight * veils.back();
  }
  return mean > 0.0 ? Roughness(places, veils) / mean : 0.0;
}

Lanes PlateVeil::At(std::size_t place) const
{
  const glm::dvec2& at = this->Places_[place].OnPlate;
  const auto u = QuadraticWeights(at.x);
  const auto v = QuadraticWeights(at.y);
  const glm::dvec2& size = this->Places_[place].Size;
  Lanes veil;
  for (const PlateColumns::Piece& row : this->Rows_.PiecesOf(at.y, size.y))
  {
    for (const PlateColumns::Piece& column : this->Columns_.PiecesOf(at.x, size.x))
    {
      // Linear through the nodes of the column and row: its mean over them stays theirs.
      const double right = this->Columns_.Between(column.Column, column.Middle());
      const double upper = this->Rows_.Between(row.Column, row.Middle());
      const auto& nodes = this->Near_[row.Column * this->Columns_.Count() + column.Column];
      for (std::size_t node = 0; node < Nodes; ++node)
      {
        const double share = column.Share * row.Share * (node % 2 == 0 ? 1.0 - right : right) *
                             (node / 2 == 0 ? 1.0 - upper : upper);
        Add(veil, nodes[node], static_cast<float>(share));
      }
    }
  }
  double steady = 0.0;
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double share = u[i] * v[j];
      const RayLight& light = this->Ways_[3 * j + i].Light;
      steady += share * light.VeilDirect;
      Add(veil, light.VeilMultiple, static_cast<float>(share));
    }
  }
  for (float& value : veil.Value)
  {
    value += static_cast<float>(steady);
  }
  return veil;
}

ShownVeil::ShownVeil(const View& view, const Vec3& eye, int band,
  const std::vector<SeenPlace>& places, const Sign& sign, const std::array<PlateAxis, 2>& axes,
  bool whole)
    : SignVeil(view, eye, band, places)
{
  const double all = std::accumulate(places.begin(), places.end(), 0.0,
    [](double sum, const SeenPlace& place) { return sum + place.Weight; });
  const bool near = whole && axes[0].Pattern.Count() * axes[1].Pattern.Count() > 1;
  const auto add = [&](const SeenPlace& place, const Vec3& point, double share)
  {
    const double distance = glm::length(point - eye);
    const Vec3 direction = (point - eye) / distance;
    const double reach = near ? GlowReach(sign, axes[0].Pattern, axes[1].Pattern, direction) : 0.0;
    const double end = std::max(0.0, distance - reach);
    this->Ways_.push_back(
      {{direction, end, share * place.Weight / all}, this->Trace(direction, 0.0, end)});
    this->Shares_.push_back(static_cast<float>(share));
    return share * this->Ways_.back().Light.Veil();
  };
  for (const SeenPlace& place : places)
  {
    this->First_.push_back(this->Ways_.size());
    double ahead = 0.0;
    if (!whole)
    {
      ahead = add(place, place.Point, 1.0);
    }
    else
    {
      for (const auto& row : axes[1].Divided.PiecesOf(place.OnPlate.y, place.Size.y))
      {
        for (const auto& column : axes[0].Divided.PiecesOf(place.OnPlate.x, place.Size.x))
        {
          const Vec3 point = OnPlate(sign, column.Middle(), row.Middle()) + OffPlate(sign, place);
          ahead += add(place, point, column.Share * row.Share);
        }
      }
    }
    if (near)
    {
      this->Near_.push_back(this->MeanCloseTo(place, sign, axes, ahead));
    }
  }
  this->First_.push_back(this->Ways_.size());
}

Lanes ShownVeil::MeanCloseTo(const SeenPlace& place, const Sign& sign,
  const std::array<PlateAxis, 2>& axes, double ahead) const
{
  // Places along an edge, and their weights.
  std::array<std::vector<glm::dvec2>, 2> nodes;
  for (int axis = 0; axis < 2; ++axis)
  {
    for (const PlateColumns::Piece& piece :
      axes[axis].Divided.PiecesOf(place.OnPlate[axis], place.Size[axis]))
    {
      if (axes[axis].Divided.Count() == 1)
      {
        nodes[axis].emplace_back(piece.Middle(), piece.Share);
        continue;
      }
      for (const double node : Nodes2)
      {
        nodes[axis].emplace_back(
          piece.Begin + node * (piece.End - piece.Begin), piece.Share / Nodes2.size());
      }
    }
  }
  const Vec3 off = OffPlate(sign, place);
  Lanes mean;
  for (const glm::dvec2& v : nodes[1])
  {
    for (const glm::dvec2& u : nodes[0])
    {
      const Vec3 to = OnPlate(sign, u.x, v.x) + off - this->Eye_;
      const double distance = glm::length(to);
      const Vec3 direction = to / distance;
      const double reach = GlowReach(sign, axes[0].Pattern, axes[1].Pattern, direction);
      Add(mean, VeilOf(this->Trace(direction, std::max(0.0, distance - reach), distance, ahead)),
        static_cast<float>(u.y * v.y));
    }
  }
  return mean;
}

Lanes ShownVeil::At(std::size_t place) const
{
  Lanes veil;
  for (std::size_t way = this->First_[place]; way < this->First_[place + 1]; ++way)
  {
    Add(veil, VeilOf(this->Ways_[way].Light), this->Shares_[way]);
  }
  if (!this->Near_.empty())
  {
    Add(veil, this->Near_[place], 1.0F);
  }
  return veil;
}

} // namespace smokevis
