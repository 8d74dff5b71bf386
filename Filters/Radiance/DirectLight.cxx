#include "DirectLight.h"

#include "GaussNodes.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis
{

namespace
{

/// A plate of a radius of so many cell edges, at most, is reached by ways that vary little. A wider
/// one is looked at so only above LeafRatio, where many parts of it ask for ways.
constexpr double WaysEdges = 1.0;
/// By how much the edges of a leaf may be off a rectangle's, in shares of them.
constexpr double EdgeShare = 1e-6;
/// Those to its corners tell of all where they tell of that to its middle, to this optical depth,
/// and differ by no more than so much: else smoke may vary between them as well.
constexpr double ToldDepth = 0.002;
constexpr double AlikeDepth = 0.04;
/// Above the finest tolerances boxes count as flat that are so many times as deep as at a small
/// one, at most: by the way to their centre and its slopes their means are right to some percent.
constexpr double MostTimes = 2.0;

bool IsRectangle(const std::array<Vec3, 4>& corners)
{
  const Vec3 along = corners[1] - corners[0];
  const Vec3 up = corners[3] - corners[0];
  const double longest = std::max(glm::length(along), glm::length(up));
  return std::abs(glm::dot(along, up)) <= EdgeShare * glm::length(along) * glm::length(up) &&
         glm::length(corners[2] - corners[1] - up) <= EdgeShare * longest;
}

} // namespace

DirectLight::DirectLight(const Scene& scene, const NearLights* near, double tolerance)
    : Scene_(scene), Sight_(scene.Shapes()), Near_(near), Bend_(BendFor(tolerance)),
      Flat_(FlatDepth * std::clamp(tolerance / FineTolerance, 1.0, MostTimes))
{
}

double DirectLight::Visible(const LightGroup& group, const Receiver& receiver) const
{
  if (receiver.Clear)
  {
    return 1.0;
  }
  switch (this->Sight_.Of(group, receiver.Point))
  {
  case Sight::None:
    return 0.0;
  case Sight::Whole:
    return 1.0;
  default:
    return this->Sight_.Share(group, receiver.Point);
  }
}

double DirectLight::Ways::At(const Vec3& place) const
{
  const double u = glm::dot(place - this->Corner, this->Along);
  const double v = glm::dot(place - this->Corner, this->Up);
  const auto along = [u](const std::array<double, 3>& of)
  { return of[0] + u * (of[1] + u * of[2]); };
  return std::max(
    0.0, along(this->Factors[0]) + v * (along(this->Factors[1]) + v * along(this->Factors[2])));
}

std::optional<DirectLight::Ways> DirectLight::WaysTo(
  const LightGroup& root, const Vec3& point) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const std::int64_t cell = smoke.Locate(point);
  if (cell < 0)
  {
    return std::nullopt;
  }
  const double distance = glm::length(root.Centre - point);
  const bool wide = root.Radius > WaysEdges * LargestEdge(smoke.CellSize(cell));
  const bool behind = glm::dot(point - root.Centre, root.Normal) < -root.Depth;
  if (wide ? behind || root.Radius < LeafRatio * distance || !IsRectangle(root.Corners)
           : root.FirstChild < 0)
  {
    return std::nullopt;
  }
  Ways ways;
  const Vec3 along = root.Corners[1] - root.Corners[0];
  const Vec3 up = root.Corners[3] - root.Corners[0];
  ways.Corner = root.Corners[0];
  ways.Along = along / glm::dot(along, along);
  ways.Up = up / glm::dot(up, up);
  std::array<std::array<double, 3>, 3> extinction;
  const auto walk = [&](int i, int j)
  {
    const Vec3 to = ways.Corner + Nodes3[i] * along + Nodes3[j] * up - point;
    const double length = glm::length(to);
    extinction[j][i] = smoke.OpticalDepth(point, to / length, 0.0, length) / length;
  };
  for (const int j : {0, 2})
  {
    walk(0, j);
    walk(2, j);
  }
  walk(1, 1);
  const std::array<double, 4> corners = {
    extinction[0][0], extinction[0][2], extinction[2][0], extinction[2][2]};
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  const double even = 0.25 * std::accumulate(corners.begin(), corners.end(), 0.0);
  // From close by, ways to the edges of a wide plate are longer than that to its centre.
  const double scale = this->Scene_.LargestScale() * (distance + (wide ? root.Radius : 0.0));
  const bool told =
    scale * std::abs(extinction[1][1] - even) < ToldDepth && scale * (*most - *least) < AlikeDepth;
  if (wide && !told)
  {
    return std::nullopt;
  }
  for (const int side : {0, 2})
  {
    const double acrossRow = 0.5 * (extinction[side][0] + extinction[side][2]);
    const double acrossColumn = 0.5 * (extinction[0][side] + extinction[2][side]);
    if (told && !wide)
    {
      extinction[side][1] = acrossRow;
      extinction[1][side] = acrossColumn;
      continue;
    }
    walk(1, side);
    walk(side, 1);
    // Between so few ways to a wide plate there may be anything, unless all tell of each other.
    const bool tell = scale * std::abs(extinction[side][1] - acrossRow) < ToldDepth &&
                      scale * std::abs(extinction[1][side] - acrossColumn) < ToldDepth;
    if (wide && !tell)
    {
      return std::nullopt;
    }
  }
  std::array<std::array<double, 3>, 3> rows;
  for (int j = 0; j < 3; ++j)
  {
    const std::array<double, 3>& row = extinction[j];
    ways.Least = std::min({ways.Least, row[0], row[1], row[2]});
    ways.Most = std::max({ways.Most, row[0], row[1], row[2]});
    rows[j] = QuadraticFactors(row);
  }
  for (int i = 0; i < 3; ++i)
  {
    const std::array<double, 3> column = QuadraticFactors({rows[0][i], rows[1][i], rows[2][i]});
    for (int j = 0; j < 3; ++j)
    {
      ways.Factors[j][i] = column[j];
    }
  }
  return ways;
}

double DirectLight::Depth(const Receiver& receiver, const Vec3& place, double distance) const
{
  if (receiver.Extinction)
  {
    return *receiver.Extinction * distance;
  }
  return receiver.Close ? receiver.Close->At(place) * distance
                        : this->Scene_.Smoke().OpticalDepth(
                            receiver.Point, (place - receiver.Point) / distance, 0.0, distance);
}

DirectLight::Path DirectLight::SamplePath(const LightGroup& group, const Receiver& receiver) const
{
  const double distance = glm::length(group.Centre - receiver.Point);
  if (!(distance > 0.0))
  {
    return {0.0, 1.0};
  }
  const double depth = this->Depth(receiver, group.Centre, distance);
  const bool dark = depth * this->Scene_.SmallestScale() > DeepestDepth;
  return {depth / distance, dark ? 0.0 : this->Visible(group, receiver)};
}

double DirectLight::ChangeOver(const LightGroup& group, const Receiver& receiver) const
{
  const double change = receiver.Close ? receiver.Close->Most * group.Radius +
                                           (receiver.Close->Most - receiver.Close->Least) *
                                             glm::length(group.Centre - receiver.Point)
                                       : this->Scene_.Smoke().MaximumExtinction() * group.Radius;
  return change * this->Scene_.LargestScale();
}

void DirectLight::WalkFar(const LightGroup& root, Receiver& receiver) const
{
  const Vec3 from = receiver.Point - root.Centre;
  if (Far(root, receiver.Point) && glm::dot(from, root.Normal) > -root.Radius)
  {
    receiver.Extinction = this->Depth(receiver, root.Centre) / glm::length(from);
  }
}

Spectrum DirectLight::Fluence(std::size_t light, const Vec3& point, bool clear) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  Receiver receiver{point, std::nullopt, clear};
  const Medium& smoke = this->Scene_.Smoke();
  if (smoke.EvenAt(point) && std::all_of(root.Corners.begin(), root.Corners.end(),
                               [&smoke](const Vec3& corner) { return smoke.EvenAt(corner); }))
  {
    receiver.Extinction = smoke.MaximumExtinction();
  }
  else if (root.Radius > PathRatio * glm::length(root.Centre - point))
  {
    receiver.Close = this->WaysTo(root, point);
  }
  else
  {
    this->WalkFar(root, receiver);
    Spectrum fluence = this->Fluence(light, receiver);
    this->DimUnevenly(light, receiver, fluence);
    return fluence;
  }
  return this->Fluence(light, receiver);
}

} // namespace smokevis
