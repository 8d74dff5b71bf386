#include "SmokeBorders.h"

#include "LightLeaves.h"
#include "Medium.h"
#include "PolygonClip.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace smokevis
{

namespace
{

/// Least step of the optical depth at which a light is divided. Each further cut takes so many
/// times the step of the one before it, and there are so many at most: smoke that varies all over
/// makes no swarm of lights.
constexpr double LeastStep = 0.1;
constexpr double StepGrowth = 4.0;
constexpr int MostCuts = 4;
/// Places along a border where smoke is looked at, and where in its part of the border each lies:
/// off the middle, where faces of cells often are and rounding would decide; how far in front of
/// the plate, and how far on either side, as shares of the plate's reach across the border.
constexpr int Places = 8;
constexpr double OffMiddle = 0.4637;
constexpr double InFront = 1e-3;
constexpr double Beside = 1e-4;
/// Sine of the angle between a plate and a border below which they run side by side.
constexpr double LeastSlant = 0.05;

} // namespace

double SmokeBorders::StepAt(
  const Border& border, const std::array<Vec3, 4>& plate, const Vec3& normal) const
{
  // Along the plate and across the border.
  Vec3 across(0.0);
  across[border.Axis] = 1.0;
  across -= normal[border.Axis] * normal;
  if (glm::length(across) < LeastSlant)
  {
    return 0.0;
  }
  const double slant = glm::length(across);
  across /= slant;
  double below = 0.0;
  double above = 0.0;
  for (const Vec3& corner : plate)
  {
    below = std::max(below, (border.Place - corner[border.Axis]) / slant);
    above = std::max(above, (corner[border.Axis] - border.Place) / slant);
  }
  const double reach = below + above;
  std::vector<Vec3> strip;
  KeepBetween(
    std::vector<Vec3>(plate.begin(), plate.end()),
    [&](const Vec3& point) { return (point[border.Axis] - border.Place) / slant; }, -Beside * reach,
    Beside * reach, strip);
  if (strip.empty())
  {
    return 0.0;
  }
  const Vec3 along = glm::cross(normal, across);
  const auto ends = std::minmax_element(strip.begin(), strip.end(),
    [&](const Vec3& a, const Vec3& b) { return glm::dot(a, along) < glm::dot(b, along); });
  // Their middle lies on the border but for the strip's width.
  Vec3 middle = 0.5 * (*ends.first + *ends.second) + InFront * reach * normal;
  middle += (border.Place - middle[border.Axis]) / slant * across;
  const double length = glm::dot(*ends.second - *ends.first, along);
  const auto extinction = [this](const Vec3& point)
  {
    const std::int64_t cell = this->Smoke_.Locate(point);
    return cell < 0 ? 0.0 : static_cast<double>(this->Smoke_.Extinction(cell));
  };
  double step = 0.0;
  for (int i = 0; i < Places; ++i)
  {
    const Vec3 point = middle + ((i + OffMiddle) / Places - 0.5) * length * along;
    step +=
      extinction(point + Beside * reach * across) - extinction(point - Beside * reach * across);
  }
  return std::abs(step) / Places * this->Scale_ * 2.0 * std::min(below, above);
}

SmokeBorders::Border SmokeBorders::Largest(const std::vector<LightGroup>& leaves) const
{
  const std::array<Vec3, 4> plate = RectangleAround(leaves, leaves.front().Centre);
  const Box bounds = Box::Around(plate);
  // A plate often lies in the outer face of the smoke: rounding must not decide whether it meets
  // it.
  const Vec3 before = InFront * glm::length(bounds.Size()) * leaves.front().Normal;
  Box near = bounds;
  near.Add({bounds.Lower + before, bounds.Upper + before});
  std::array<std::set<double>, 3> places;
  this->Smoke_.ForCellsIn(near.Lower, near.Upper,
    [&](std::int64_t cell)
    {
      const Box box = this->Smoke_.BoxOf(cell);
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const double place : {box.Lower[axis], box.Upper[axis]})
        {
          if (place > bounds.Lower[axis] && place < bounds.Upper[axis])
          {
            places[axis].insert(place);
          }
        }
      }
    });
  Border largest;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double place : places[axis])
    {
      Border border{axis, place};
      border.Step = this->StepAt(border, plate, leaves.front().Normal);
      if (border.Step > largest.Step)
      {
        largest = border;
      }
    }
  }
  return largest;
}

std::vector<std::vector<LightGroup>> SmokeBorders::Divide(std::vector<LightGroup> leaves) const
{
  return DivideLeaves(std::move(leaves),
    [this](const std::vector<LightGroup>& group, int cuts) -> std::optional<Plane>
    {
      const Border border = cuts < MostCuts ? this->Largest(group) : Border{};
      if (border.Step < LeastStep * std::pow(StepGrowth, cuts))
      {
        return std::nullopt;
      }
      Plane plane;
      plane.Normal[border.Axis] = 1.0;
      plane.Offset = border.Place;
      return plane;
    });
}

} // namespace smokevis
