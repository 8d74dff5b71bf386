#include "GlobalLines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// A line of the uniform measure of lines through a box: it enters anywhere on the box's surface
/// with a cosine-distributed direction.
void DrawThrough(const Box& box, const std::array<double, 4>& random, Vec3& origin, Vec3& direction)
{
  const Vec3 size = box.Upper - box.Lower;
  const Vec3 faces(size.y * size.z, size.z * size.x, size.x * size.y);
  // The first number chooses one of six faces and then a place on it.
  double pick = random[0] * 2.0 * (faces.x + faces.y + faces.z);
  int axis = 0;
  while (axis < 2 && pick >= 2.0 * faces[axis])
  {
    pick -= 2.0 * faces[axis];
    ++axis;
  }
  const bool high = pick >= faces[axis];
  const double place = std::clamp((pick - (high ? faces[axis] : 0.0)) / faces[axis], 0.0, 1.0);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  origin[axis] = high ? box.Upper[axis] : box.Lower[axis];
  origin[u] = box.Lower[u] + place * size[u];
  origin[v] = box.Lower[v] + random[1] * size[v];
  const double sine = std::sqrt(random[2]);
  const double angle = glm::two_pi<double>() * random[3];
  direction[axis] = (high ? -1.0 : 1.0) * std::sqrt(1.0 - random[2]);
  direction[u] = sine * std::cos(angle);
  direction[v] = sine * std::sin(angle);
}

/// A line through two places anywhere in two boxes.
void DrawJoining(const Box& from, const Box& to, const std::array<double, 6>& random, Vec3& origin,
  Vec3& direction)
{
  origin = from.Lower + Vec3(random[0], random[1], random[2]) * from.Size();
  const Vec3 way = to.Lower + Vec3(random[3], random[4], random[5]) * to.Size() - origin;
  const double length = glm::length(way);
  direction = length > 0.0 ? way / length : Vec3(1.0, 0.0, 0.0);
}

} // namespace

std::size_t GlobalLines::AtLeast(double wanted)
{
  constexpr double rounding = 1e-9;
  return static_cast<std::size_t>(std::ceil((1.0 - rounding) * wanted));
}

GlobalLines::GlobalLines(const Box& scene, std::size_t lines) : Kinds_{{scene, lines, lines}}
{
}

void GlobalLines::AddInner(const Box& inner, std::size_t lines)
{
  this->Kinds_.push_back({inner, lines, this->Count() + lines});
}

void GlobalLines::AddJoining(const Box& from, const Box& to, std::size_t lines)
{
  this->Kinds_.push_back({from, lines, this->Count() + lines, to});
}

double GlobalLines::Kind::DensityAt(const Stretch& through, const Stretch& with) const
{
  // Pairs of places are as many as pairs along each line times the square of their distance
  // (Santalo 1976), which is the second derivative by both of a twelfth of its fourth power.
  const auto fourth = [](double distance) { return distance * distance * distance * distance; };
  const double pairs = (fourth(through.Leave - with.Enter) + fourth(through.Enter - with.Leave) -
                         fourth(through.Leave - with.Leave) - fourth(through.Enter - with.Enter)) /
                       12.0;
  return glm::half_pi<double>() * static_cast<double>(this->Lines) * std::max(0.0, pairs) /
         (this->Through.Volume() * this->With->Volume());
}

GlobalLines GlobalLines::Thinned(double share) const
{
  const auto part = [share](const Kind& kind)
  { return AtLeast(share * static_cast<double>(kind.Lines)); };
  GlobalLines thinned(this->Outer(), part(this->Kinds_.front()));
  for (auto kind = this->Kinds_.begin() + 1; kind != this->Kinds_.end(); ++kind)
  {
    const std::size_t lines = part(*kind);
    thinned.Kinds_.push_back({kind->Through, lines, thinned.Count() + lines, kind->With});
  }
  return thinned;
}

double GlobalLines::Meetings(double area, const Box& bounds) const
{
  double density = this->Kinds_.front().Density();
  for (auto kind = this->Kinds_.begin() + 1; kind != this->Kinds_.end(); ++kind)
  {
    const bool inside =
      kind->Through.Contains(bounds.Lower) && kind->Through.Contains(bounds.Upper);
    density += inside ? kind->Density() : 0.0;
  }
  return area * density;
}

GlobalLines::Draw::Draw(const GlobalLines& lines, std::uint64_t key) : Lines_(lines), Key_(key)
{
  for (std::size_t kind = 0; kind < lines.Kinds_.size(); ++kind)
  {
    this->Points_.emplace_back(key);
    this->Pairs_.emplace_back(key);
    key = Mix(key);
  }
}

GlobalLines::Line GlobalLines::Draw::Get(std::size_t index) const
{
  const std::vector<Kind>& kinds = this->Lines_.Kinds_;
  const auto drawn = std::find_if(
    kinds.begin(), kinds.end(), [index](const Kind& kind) { return index < kind.End; });
  const std::size_t kind = drawn - kinds.begin();
  const std::size_t own = index - (drawn->End - drawn->Lines);
  Line line;
  if (drawn->With)
  {
    DrawJoining(
      drawn->Through, *drawn->With, this->Pairs_[kind].Point(own), line.Origin, line.Direction);
  }
  else
  {
    DrawThrough(drawn->Through, this->Points_[kind].Point(own), line.Origin, line.Direction);
  }
  const Vec3 inverse = 1.0 / line.Direction;
  const auto stretch = [&](const Box& box)
  {
    Stretch ends{-Infinity, Infinity};
    return box.Clip(line.Origin, inverse, ends.Enter, ends.Leave) ? ends : Stretch{};
  };
  double density = kinds.front().Density();
  for (auto other = kinds.begin() + 1; other != kinds.end(); ++other)
  {
    if (other->With)
    {
      density += other->DensityAt(stretch(other->Through), stretch(*other->With));
      continue;
    }
    const auto [enter, leave] = stretch(other->Through);
    density += other == drawn || leave > enter ? other->Density() : 0.0;
  }
  const auto [begin, end] = stretch(kinds.front().Through);
  line.Origin += begin * line.Direction;
  line.Length = end - begin;
  line.Random = ToUnit(Mix(this->Key_ ^ Mix(index)));
  // All directed lines through a convex body measure pi times its surface. Each line drawn serves
  // in both of its directions.
  line.Weight = glm::half_pi<double>() / density;
  return line;
}

} // namespace smokevis
