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

} // namespace

GlobalLines::GlobalLines(const Box& scene, std::size_t lines)
    : Scene_(scene), Lines_(lines),
      // All directed lines through a convex body measure pi times its surface. Each line drawn
      // serves in both of its directions.
      Weight_(glm::half_pi<double>() * scene.Surface() / static_cast<double>(lines)),
      InnerWeight_(this->Weight_)
{
}

void GlobalLines::AddInner(const Box& inner, std::size_t lines)
{
  this->Inner_ = inner;
  this->InnerLines_ = lines;
  this->InnerWeight_ = glm::half_pi<double>() / this->Meetings(1.0, true);
}

GlobalLines GlobalLines::Thinned(double share) const
{
  const auto part = [share](std::size_t lines)
  { return static_cast<std::size_t>(std::ceil(share * static_cast<double>(lines))); };
  GlobalLines thinned(this->Scene_, part(this->Lines_));
  if (this->Inner_)
  {
    thinned.AddInner(*this->Inner_, part(this->InnerLines_));
  }
  return thinned;
}

double GlobalLines::Meetings(double area, bool inside) const
{
  const double outer = static_cast<double>(this->Lines_) * area / this->Scene_.Surface();
  return this->Inner_ && inside
           ? outer + static_cast<double>(this->InnerLines_) * area / this->Inner_->Surface()
           : outer;
}

GlobalLines::Draw::Draw(const GlobalLines& lines, std::uint64_t key)
    : Lines_(lines), Key_(key), Points_(key), InnerPoints_(Mix(key))
{
}

GlobalLines::Line GlobalLines::Draw::Get(std::size_t index) const
{
  const GlobalLines& lines = this->Lines_;
  Line line;
  const bool drawnInside = index >= lines.Lines_;
  DrawThrough(drawnInside ? *lines.Inner_ : lines.Scene_,
    drawnInside ? this->InnerPoints_.Point(index - lines.Lines_) : this->Points_.Point(index),
    line.Origin, line.Direction);
  const Vec3 inverse = 1.0 / line.Direction;
  const auto stretch = [&](const Box& box)
  {
    std::pair<double, double> ends(-Infinity, Infinity);
    box.Clip(line.Origin, inverse, ends.first, ends.second);
    return ends;
  };
  bool meetsInner = drawnInside;
  if (lines.Inner_ && !drawnInside)
  {
    const auto [enter, leave] = stretch(*lines.Inner_);
    meetsInner = leave > enter;
  }
  const auto [begin, end] = stretch(lines.Scene_);
  line.Origin += begin * line.Direction;
  line.Length = end - begin;
  line.Random = ToUnit(Mix(this->Key_ ^ Mix(index)));
  line.Weight = meetsInner ? lines.InnerWeight_ : lines.Weight_;
  return line;
}

} // namespace smokevis
