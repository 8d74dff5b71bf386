#include "PatchGroups.h"

#include "Scene.h"
#include "SharedCorners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace smokevis
{

namespace
{

/// Sides that fewer lines meet in a sweep are put together until about so many do. Each sweep sends
/// on what the last one found: of its variance the square of the reflectance over the hits, which
/// must be well below 1.
constexpr double GroupHits = 4.0;
double FewestHits(double reflectance)
{
  constexpr double least = 0.7;
  constexpr double aSquare = 2.5;
  return std::max(least, aSquare * reflectance * reflectance);
}

/// Share of a cube's edge at which the scene's lower corner lies in its cube: rounding would decide
/// on which side of a border walls lie that end the scene.
constexpr double OffBorder = 0.4637;

/// Where a patch lies, and whom it may be put together with. In the scene's sizes, from its lower
/// corner on, so that the unit of length and the place of the origin change nothing.
struct Place
{
  Vec3 Centre{0.0}, Normal{0.0};
  double Area = 0.0;
};

/// Binary exponent of the edge of the cubes that groups are cut by, the cube, the axis and the
/// sense that they mainly face, and their reflectance.
using Kind = std::tuple<int, std::array<std::int64_t, 3>, int, double>;

Kind KindOf(const Place& place, double hits, double reflectance)
{
  const int scale = static_cast<int>(std::lround(0.5 * std::log2(GroupHits * place.Area / hits)));
  const double edge = std::exp2(scale);
  std::array<std::int64_t, 3> cube;
  int facing = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    cube[axis] = std::llround(std::floor(place.Centre[axis] / edge + OffBorder));
    facing = std::abs(place.Normal[axis]) > std::abs(place.Normal[facing]) ? axis : facing;
  }
  return {scale, cube, 2 * facing + (place.Normal[facing] > 0.0 ? 1 : 0), reflectance};
}

} // namespace

PatchGroups::PatchGroups(const Scene& scene, int band, std::vector<float>& hits)
{
  const std::size_t patches = scene.SurfacePatches();
  std::vector<Place> places(patches);
  const auto small = [&](std::size_t patch)
  {
    const float most = std::max(hits[2 * patch], hits[2 * patch + 1]);
    return most > 0.0F && most < FewestHits(scene.PatchReflectance(patch)[band]);
  };
  scene.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners)
    {
      if (patch >= patches || !small(patch))
      {
        return;
      }
      const double area = AreaOf(corners);
      places[patch].Area += area;
      places[patch].Normal += AreaVector(corners);
      places[patch].Centre += area * CentreOf(corners);
    });
  const double size = glm::length(scene.Upper() - scene.Lower());
  // Patches of one kind that share a corner.
  std::map<Kind, std::vector<std::uint32_t>> kinds;
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    Place& place = places[patch];
    if (place.Area > 0.0)
    {
      place.Centre = (place.Centre / place.Area - scene.Lower()) / size;
      place.Area /= size * size;
      kinds[KindOf(place, std::max(hits[2 * patch], hits[2 * patch + 1]),
              scene.PatchReflectance(patch)[band])]
        .push_back(static_cast<std::uint32_t>(patch));
    }
  }
  if (kinds.empty())
  {
    return;
  }
  std::vector<std::uint32_t> kindOf(patches, 0);
  std::uint32_t number = 0;
  for (const auto& [kind, members] : kinds)
  {
    ++number;
    for (const std::uint32_t patch : members)
    {
      kindOf[patch] = number;
    }
  }
  std::vector<SharedCorner> all;
  scene.ForEachTriangle(
    [&](std::size_t patch, const Triangle& corners)
    {
      for (const Vec3& corner : corners)
      {
        if (patch < patches && kindOf[patch] > 0)
        {
          all.push_back(MakeSharedCorner(
            kindOf[patch], corner - scene.Lower(), static_cast<std::uint32_t>(patch), size));
        }
      }
    });
  boost::disjoint_sets_with_storage<> sets(patches);
  UniteAtCorners(all, sets);
  std::map<std::size_t, std::vector<std::uint32_t>> groups;
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    if (kindOf[patch] > 0)
    {
      groups[sets.find_set(patch)].push_back(static_cast<std::uint32_t>(patch));
    }
  }
  for (const auto& [root, members] : groups)
  {
    for (int side = 0; side < 2 && members.size() > 1; ++side)
    {
      double area = 0.0;
      float together = 0.0F;
      for (const std::uint32_t patch : members)
      {
        area += scene.ExposedArea(patch, side);
        together += hits[2 * patch + side];
      }
      if (!(area > 0.0))
      {
        continue;
      }
      this->First_.push_back(this->Sides_.size());
      for (const std::uint32_t patch : members)
      {
        // What is covered stays dark.
        if (scene.ExposedArea(patch, side) > 0.0)
        {
          this->Sides_.push_back(2 * patch + side);
          this->Shares_.push_back(static_cast<float>(scene.ExposedArea(patch, side) / area));
          hits[2 * patch + side] = together;
        }
      }
    }
  }
  this->First_.push_back(this->Sides_.size());
}

void PatchGroups::Average(std::vector<float>& illuminance) const
{
  for (std::size_t group = 1; group < this->First_.size(); ++group)
  {
    double mean = 0.0;
    for (std::size_t i = this->First_[group - 1]; i < this->First_[group]; ++i)
    {
      mean += this->Shares_[i] * illuminance[this->Sides_[i]];
    }
    for (std::size_t i = this->First_[group - 1]; i < this->First_[group]; ++i)
    {
      illuminance[this->Sides_[i]] = static_cast<float>(mean);
    }
  }
}

} // namespace smokevis
