// DirectLight's part for boxes of smoke: means over them.
#include "DirectLight.h"

#include "ExponentialMean.h"
#include "GaussNodes.h"
#include "NearField.h"
#include "Places.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

struct DirectLight::GaussPlace
{
  Vec3 Point;
  double Weight;
  /// Optical depth at 633 nm between it and the light's centre, where that is known.
  double Depth = 0.0;
  /// What a light that were a point would send there, over what it would send to the box's centre.
  double Share = 0.0;
};

namespace
{

/// Slabs that a box which light hardly gets into is cut into, at most.
constexpr int MostSlabs = 24;
/// Optical depth along an axis from which on light gets in so little, less than a hundredth of the
/// box, that what comes in through one face does not meet what does through another.
constexpr double ThinDepth = 256.0;
/// The same below which next to none does.
constexpr double NoDepth = 1e-3;
/// Share of a light's intensity towards any place in a box that there is towards its centre, where
/// the centre tells of all: beams end within boxes.
constexpr double SteadyShare = 0.2;

/// Least part of a box that counts as cut off by a plate, and one minus the cosine of the angle by
/// which the plate may lean against the box's faces (1.4 mrad).
constexpr double Upright = 1e-6;

/// Slabs along all axes at once, or one set after the other where light is lost right behind each
/// face that it comes in through: what deepens so fast along one axis is dark where another one
/// tells of it.
/// @param depth of the box along each axis
std::vector<std::array<int, 3>> ApartWhereThin(const std::array<int, 3>& slabs, const Vec3& depth)
{
  std::vector<std::array<int, 3>> sets;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (depth[axis] >= ThinDepth)
    {
      std::array<int, 3>& set = sets.emplace_back(std::array<int, 3>{1, 1, 1});
      set[axis] = slabs[axis];
    }
    else if (depth[axis] > NoDepth)
    {
      // Light that comes in there fills the box.
      return {slabs};
    }
  }
  return sets;
}

/// Mean of exp(-2 x t) over t in (-1/2, 1/2), over its value at t = -shift / 2.
double MeanAttenuation(double x, double shift)
{
  return std::exp(LogarithmOfMean(x) - x * shift);
}

} // namespace

void DirectLight::AddGaussPlaces(const Vec3& centre, const Vec3& size,
  const std::array<int, 3>& orders, double share, std::vector<GaussPlace>& places)
{
  constexpr std::array<std::array<double, 3>, 3> nodes = {
    {{0.5}, {Nodes2[0], Nodes2[1]}, {Nodes3[0], Nodes3[1], Nodes3[2]}}};
  constexpr std::array<std::array<double, 3>, 3> weights = {
    {{1.0}, {0.5, 0.5}, {Weights3[0], Weights3[1], Weights3[2]}}};
  ForEachPlace(orders,
    [&](const std::array<int, 3>& index)
    {
      double weight = share;
      Vec3 place;
      for (int axis = 0; axis < 3; ++axis)
      {
        place[axis] = nodes[orders[axis] - 1][index[axis]];
        weight *= weights[orders[axis] - 1][index[axis]];
      }
      places.push_back({centre + (place - 0.5) * size, weight});
    });
}

Spectrum DirectLight::Fluence(
  const BoxLight& light, const Vec3& point, const std::optional<double>& extinction) const
{
  if (light.Near && light.Near->Smooth(point))
  {
    Spectrum value{};
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      value[band] = light.Near->Fluence(point, band);
    }
    return value;
  }
  return extinction
           ? this->Fluence(light.Index, Receiver{point, std::nullopt, true, {}, extinction})
           : this->Fluence(light.Index, point, true);
}

double DirectLight::PointLight(const LightGroup& light, const Vec3& way)
{
  const double square = glm::dot(way, way);
  const double distance = std::sqrt(square);
  const double cosine = glm::dot(way, light.Normal) / distance;
  return cosine / square * light.Law.Relative(way / distance, cosine);
}

std::optional<Box> DirectLight::BeforePlate(const LightGroup& root, const Box& box)
{
  for (int axis = 0; axis < 3 && root.Plane(); ++axis)
  {
    const double height = std::abs(box.Centre()[axis] - root.Centre[axis]);
    if (std::abs(root.Normal[axis]) > 1.0 - Upright &&
        height < (1.0 - Upright) * 0.5 * box.Size()[axis])
    {
      Box front = box;
      (root.Normal[axis] > 0.0 ? front.Lower : front.Upper)[axis] = root.Centre[axis];
      return front;
    }
  }
  return std::nullopt;
}

Spectrum DirectLight::LitBoxFluence(const BoxLight& light, const Box& box, int splits) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const std::optional<Box> front = BeforePlate(root, box);
  if (!front)
  {
    return this->BoxFluence(light, box.Centre(), box.Size(), splits);
  }
  BoxLight moved = light;
  moved.Ways = light.Ways.Moved(box.Centre() - root.Centre, front->Centre() - box.Centre());
  Spectrum value = this->BoxFluence(moved, front->Centre(), front->Size(), splits);
  for (double& each : value)
  {
    each *= front->Volume() / box.Volume();
  }
  return value;
}

bool DirectLight::Behind(const LightGroup& root, const Vec3& centre, const Vec3& size)
{
  return glm::dot(centre - root.Centre, root.Normal) + 0.5 * glm::length(size) < -root.Radius;
}

Spectrum DirectLight::BoxFluence(
  const BoxLight& light, const Vec3& centre, const Vec3& size, int splits) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const Vec3 from = centre - root.Centre;
  const double toCentre = glm::length(from);
  const double distance = root.Distance(centre);
  if (Behind(root, centre, size))
  {
    return {};
  }
  const double highest = glm::dot(from, root.Normal) + 0.5 * glm::dot(glm::abs(root.Normal), size);
  const double coarseness =
    root.Law.Coarseness(highest + root.Depth, distance - 0.5 * glm::length(size));
  const double edge = LargestEdge(size) * root.Law.Sharpness() / coarseness;
  if (splits > 0 && edge > BoxRatio * distance)
  {
    Spectrum sum{};
    for (int part = 0; part < 8; ++part)
    {
      const Vec3 shift(part & 1 ? 0.25 : -0.25, part & 2 ? 0.25 : -0.25, part & 4 ? 0.25 : -0.25);
      BoxLight moved = light;
      moved.Ways = light.Ways.Moved(from, shift * size);
      const Spectrum value = this->BoxFluence(moved, centre + shift * size, 0.5 * size, splits - 1);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        sum[band] += 0.125 * value[band];
      }
    }
    return sum;
  }
  Vec3 middle = centre;
  Vec3 extent = size;
  double lit = 1.0;
  const bool close = edge > BoxRatio * distance;
  if (close)
  {
    // As fine as boxes get. One that the plate's plane cuts is lit only in front of it.
    const double height = glm::dot(from, root.Normal);
    const double reach = 0.5 * glm::dot(glm::abs(root.Normal), size);
    lit = std::clamp(0.5 * (height / reach + 1.0), 0.0, 1.0);
    middle += (lit < 1.0 ? 0.5 * (reach - height) : 0.0) * root.Normal;
    extent *= glm::mix(Vec3(1.0), Vec3(lit), glm::abs(root.Normal));
  }
  if (lit == 0.0)
  {
    return {};
  }
  const double depth = this->BoxDepth(light.Cell, size);
  const Vec3 within = glm::abs(light.Ways.Slope) * size * this->Scene_.LargestScale();
  const Vec3 entering = light.Ways.Entry * size * this->Scene_.LargestScale();
  const bool deepest = LargestEdge(within) >= DeepestGauss;
  if (!close && !light.Weak)
  {
    const bool thick = std::max(depth, LargestEdge(entering)) >=
                       (depth > this->Flat_ ? DeepestGauss : TwoPointDepth);
    if (thick)
    {
      return this->GradedFluence(light, centre, size);
    }
    if (!deepest && depth < DeepestGauss && (depth > this->Flat_ || edge > FlatRatio * distance))
    {
      return this->GaussFluence(light, centre, size);
    }
  }
  // Mean over the box. Along a slope of the optical depth its exponential is exact; its mean lies
  // at a place of its own, where the rest of the light's variation is taken.
  const Vec3 along = toCentre > root.Radius ? from / toCentre : root.Normal;
  Vec3 place = middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] -=
      0.5 * extent[axis] *
      Langevin(0.5 * this->Scene_.ExtinctionScale(0) * light.Ways.Slope[axis] * extent[axis]);
  }
  // What deepens so fast is not told that far from the centre.
  Spectrum value = this->Fluence(light, place,
    deepest && !light.Weak ? std::nullopt : this->ExtinctionFrom(light, centre, place));
  double curvature = 1.0;
  if (!close)
  {
    // What is left: second derivatives of cos / d^2.
    for (int axis = 0; axis < 3; ++axis)
    {
      curvature += extent[axis] * extent[axis] * (9.0 * along[axis] * along[axis] - 3.0) /
                   (24.0 * toCentre * toCentre);
    }
  }
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    // Off its axis a way is longer: second derivatives of the distance.
    double longer = 0.0;
    for (int axis = 0; axis < 3 && !close; ++axis)
    {
      longer += extent[axis] * extent[axis] * (1.0 - along[axis] * along[axis]) / (24.0 * toCentre);
    }
    const double scale = this->Scene_.ExtinctionScale(band);
    double factor = lit * curvature * std::exp(-scale * light.Ways.Mean * longer);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double half = 0.5 * light.Ways.Slope[axis] * extent[axis];
      const double shift = Langevin(this->Scene_.ExtinctionScale(0) * half);
      const double own = Langevin(scale * half);
      factor *= MeanAttenuation(scale * half, shift);
      // Mean square of the distance from the centre, over that of the place.
      const double spread = LangevinSlope(scale * half) + own * own - shift * shift;
      factor *=
        std::exp(-0.125 * scale * light.Ways.Bend[axis] * extent[axis] * extent[axis] * spread);
    }
    value[band] *= factor;
  }
  return value;
}

std::optional<double> DirectLight::ExtinctionFrom(
  const BoxLight& light, const Vec3& centre, const Vec3& place) const
{
  const Vec3& target = this->Scene_.Lights().Root(light.Index).Centre;
  const double distance = glm::length(place - target);
  if (!light.Far || !(distance > 0.0))
  {
    return std::nullopt;
  }
  const Vec3 from = centre - target;
  const double depth = light.Ways.Mean * glm::length(from) + light.Ways.At(from, place - centre);
  return std::max(0.0, depth) / distance;
}

double DirectLight::BoxDepth(std::int64_t cell, const Vec3& size) const
{
  return this->Scene_.Smoke().Extinction(cell) * this->Scene_.LargestScale() * LargestEdge(size);
}

double DirectLight::SteepestDepth(const BoxLight& light, const Vec3& size) const
{
  const Vec3 slope = glm::max(glm::abs(light.Ways.Slope), light.Ways.Entry);
  return std::max(
    this->BoxDepth(light.Cell, size), LargestEdge(slope * size) * this->Scene_.LargestScale());
}

void DirectLight::AddSlabs(const Vec3& centre, const Vec3& size, const Vec3& from,
  const std::array<int, 3>& slabs, const std::array<int, 3>& orders,
  std::vector<GaussPlace>& places)
{
  ForEachPlace(slabs,
    [&](const std::array<int, 3>& slab)
    {
      Vec3 middle = centre;
      Vec3 extent = size;
      double share = 1.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double end = std::ldexp(1.0, slab[axis] - slabs[axis] + 1);
        const double begin = slab[axis] == 0 ? 0.0 : 0.5 * end;
        const double inwards = from[axis] >= 0.0 ? 1.0 : -1.0;
        middle[axis] += inwards * (0.5 * (begin + end) - 0.5) * size[axis];
        extent[axis] *= end - begin;
        share *= end - begin;
      }
      AddGaussPlaces(middle, extent, orders, share, places);
    });
}

Spectrum DirectLight::GradedFluence(
  const BoxLight& light, const Vec3& centre, const Vec3& size) const
{
  // Slabs from the faces that light comes in through, each half as thick as the one behind it,
  // until the first is thin; without such faces across the axis along which ways deepen most.
  const double scale = this->Scene_.LargestScale();
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const Vec3 from = centre - root.Centre;
  const Vec3 within = glm::abs(light.Ways.Slope) * size * scale;
  const Vec3 entering = light.Ways.Entry * size * scale;
  const bool enters = LargestEdge(entering) >= TwoPointDepth;
  std::array<int, 3> slabs;
  std::array<int, 3> orders;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double depth = std::max(within[axis], entering[axis]);
    const bool graded =
      enters ? entering[axis] >= TwoPointDepth : within[axis] == LargestEdge(within);
    const double thickest = std::max(depth, this->BoxDepth(light.Cell, size));
    slabs[axis] =
      graded ? std::min(MostSlabs, 2 + static_cast<int>(std::log2(std::max(1.0, thickest)))) : 1;
    // Along the others one place does for light that hardly changes.
    const bool flat = depth < 2.0 * FlatDepth && size[axis] < FlatRatio * glm::length(from);
    orders[axis] = !graded && flat ? 1 : 2;
  }
  thread_local std::vector<GaussPlace> places;
  places.clear();
  for (const std::array<int, 3>& each : ApartWhereThin(slabs, glm::max(within, entering)))
  {
    AddSlabs(centre, size, from, each, orders, places);
  }
  if (!this->Pointlike(light, centre, size, places))
  {
    Spectrum sum{};
    for (const GaussPlace& place : places)
    {
      const Spectrum value = this->Fluence(light, place.Point, std::nullopt);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        sum[band] += place.Weight * value[band];
      }
    }
    return sum;
  }
  double least = std::numeric_limits<double>::infinity();
  for (GaussPlace& place : places)
  {
    const Vec3 to = root.Centre - place.Point;
    const double distance = glm::length(to);
    place.Depth = this->Scene_.Smoke().OpticalDepth(place.Point, to / distance, 0.0, distance);
    least = std::min(least, place.Depth);
  }
  // Beyond the least depth light is only dimmed, however deep the smoke.
  return this->PointlikeMean(light, centre, least / glm::length(from), places);
}

bool DirectLight::Pointlike(const BoxLight& light, const Vec3& centre, const Vec3& size,
  std::vector<GaussPlace>& places) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const Vec3 from = centre - root.Centre;
  const double atCentre = PointLight(root, from);
  return root.Radius * root.Law.Sharpness() < PathRatio * glm::length(from) && root.Plane() &&
         glm::dot(from, root.Normal) > glm::dot(glm::abs(root.Normal), size) &&
         std::all_of(places.begin(), places.end(),
           [&](GaussPlace& place)
           {
             place.Share = PointLight(root, place.Point - root.Centre) / atCentre;
             return SteadyShare * place.Share < 1.0;
           });
}

Spectrum DirectLight::PointlikeMean(const BoxLight& light, const Vec3& centre, double extinction,
  const std::vector<GaussPlace>& places) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const Vec3 from = centre - root.Centre;
  const double depth = extinction * glm::length(from);
  Spectrum mean{};
  for (const GaussPlace& place : places)
  {
    const double weight = place.Weight * place.Share;
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      mean[band] += weight * std::exp(-this->Scene_.ExtinctionScale(band) * (place.Depth - depth));
    }
  }
  Spectrum value = this->Fluence(light.Index, Receiver{centre, std::nullopt, true, {}, extinction});
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    value[band] *= mean[band];
  }
  return value;
}

bool DirectLight::BehindBorder(const BoxLight& light) const
{
  return light.Ways.Border * this->Scene_.LargestScale() >= FlatDepth;
}

Spectrum DirectLight::GaussFluence(
  const BoxLight& light, const Vec3& centre, const Vec3& size) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const Vec3 from = centre - root.Centre;
  const double toCentre = glm::length(from);
  const double edge = LargestEdge(size) * root.Law.Sharpness();
  const bool slow = edge < TwoPointRatio * root.Distance(centre);
  const int order = slow && this->SteepestDepth(light, size) < TwoPointDepth ? 2 : 3;
  thread_local std::vector<GaussPlace> places;
  places.clear();
  AddGaussPlaces(centre, size, {order, order, order}, 1.0, places);
  Spectrum sum{};
  const bool even = !this->BehindBorder(light);
  if (!even || !(root.Radius * root.Law.Sharpness() < PathRatio * toCentre))
  {
    for (const GaussPlace& place : places)
    {
      const Spectrum value = this->Fluence(
        light, place.Point, even ? this->ExtinctionFrom(light, centre, place.Point) : std::nullopt);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        sum[band] += place.Weight * value[band];
      }
    }
    return sum;
  }
  Receiver receiver{centre, std::nullopt, true};
  if (light.Far)
  {
    receiver.Extinction = light.Ways.Mean;
  }
  const double depth = this->Depth(receiver, root.Centre);
  if (depth * this->Scene_.SmallestScale() > DeepestDepth)
  {
    return {};
  }
  for (GaussPlace& place : places)
  {
    place.Depth = std::max(0.0, depth + light.Ways.At(from, place.Point - centre));
  }
  if (this->Pointlike(light, centre, size, places))
  {
    return this->PointlikeMean(light, centre, depth / toCentre, places);
  }
  for (const GaussPlace& place : places)
  {
    receiver.Point = place.Point;
    receiver.Extinction = place.Depth / glm::length(root.Centre - place.Point);
    const Spectrum value = this->Fluence(light.Index, receiver);
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sum[band] += place.Weight * value[band];
    }
  }
  return sum;
}

} // namespace smokevis
