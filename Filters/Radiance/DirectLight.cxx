#include "DirectLight.h"

#include "GaussNodes.h"
#include "PolygonLight.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis
{

namespace
{

/// A group of radius r at a distance d acts as one point below this r/d: the error is of the order
/// (r/d)^2. A leaf has a closed form, so it turns into a point only where that costs digits no
/// more.
constexpr double PointRatio = 1.0 / 32.0;
constexpr double LeafPointRatio = 1.0 / 128.0;
/// A leaf is split above this r/d, where three Gauss points an edge do not follow its transmittance
/// any more: in four, or in two where one edge is so many times the other. How often: that in four
/// counts three times.
constexpr double LeafRatio = 0.7;
constexpr int LeafSplits = 12;
/// The same where light goes as a power of the cosine, which no few points follow close to a leaf:
/// parts are split down to their distance.
constexpr int SteepLeafSplits = 66;
constexpr int SplitInFour = 3;
constexpr double SlenderRatio = 1.517;
constexpr double CutRatio = 0.02;
/// Optical depth across a leaf below which its transmittance is known however close it is.
constexpr double EvenDepth = 0.04;
/// Optical depth across the radius of a group above which its light does not go smoothly enough for
/// the few places of a stencil.
constexpr double StencilDepth = 1.0;
/// A plate of a radius of so many cell edges, at most, is reached by ways that vary little.
constexpr double WaysEdges = 1.0;
/// Those to its corners tell of all where they tell of that to its middle, to this optical depth,
/// and differ by no more than so much: else smoke may vary between them as well.
constexpr double ToldDepth = 0.002;
constexpr double AlikeDepth = 0.04;

int SplitsOf(const EmissionLaw& law)
{
  return law.Lambertian() ? LeafSplits : SteepLeafSplits;
}

LightGroup Part(const LightGroup& leaf, double u0, double u1, double v0, double v1)
{
  LightGroup part = leaf;
  part.Corners = {leaf.At(u0, v0), leaf.At(u1, v0), leaf.At(u1, v1), leaf.At(u0, v1)};
  part.Centre = leaf.At(0.5 * (u0 + u1), 0.5 * (v0 + v1));
  part.Radius = 0.0;
  for (const Vec3& corner : part.Corners)
  {
    part.Radius = std::max(part.Radius, glm::length(corner - part.Centre));
  }
  part.Area = 0.5 * glm::length(glm::cross(
                      part.Corners[2] - part.Corners[0], part.Corners[3] - part.Corners[1]));
  for (double& intensity : part.Intensity)
  {
    intensity *= part.Area / leaf.Area;
  }
  return part;
}

/// Share of a light's radius that counts as none above a horizon, and angle as none between
/// normals.
constexpr double PlaneShare = 1e-6;

/// Whether a light faces where a receiver faces that lies in its plane, or before it, but for
/// rounding: nothing of it is above the receiver's horizon.
/// @param height of the receiver over the plane through the group's centre
bool InOnePlane(const LightGroup& group, double height, const std::optional<Vec3>& receiverNormal)
{
  return receiverNormal && group.Depth - height <= PlaneShare * group.Radius &&
         glm::dot(group.Normal, *receiverNormal) >= 1.0 - PlaneShare * PlaneShare;
}

} // namespace

DirectLight::DirectLight(const Scene& scene, const NearLights* near)
    : Scene_(scene), Sight_(scene.Shapes()), Near_(near)
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
  if (cell < 0 || root.FirstChild < 0)
  {
    return std::nullopt;
  }
  const Vec3 size = smoke.CellSize(cell);
  if (root.Radius > WaysEdges * LargestEdge(size))
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
    const double distance = glm::length(to);
    extinction[j][i] = smoke.OpticalDepth(point, to / distance, 0.0, distance) / distance;
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
  const double scale = this->Scene_.LargestScale() * glm::length(root.Centre - point);
  const bool told =
    scale * std::abs(extinction[1][1] - even) < ToldDepth && scale * (*most - *least) < AlikeDepth;
  for (const int side : {0, 2})
  {
    if (told)
    {
      extinction[side][1] = 0.5 * (extinction[side][0] + extinction[side][2]);
      extinction[1][side] = 0.5 * (extinction[0][side] + extinction[2][side]);
    }
    else
    {
      walk(1, side);
      walk(side, 1);
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

double DirectLight::Depth(const Receiver& receiver, const Vec3& place) const
{
  const Vec3 to = place - receiver.Point;
  const double distance = glm::length(to);
  if (receiver.Extinction)
  {
    return *receiver.Extinction * distance;
  }
  return receiver.Close
           ? receiver.Close->At(place) * distance
           : this->Scene_.Smoke().OpticalDepth(receiver.Point, to / distance, 0.0, distance);
}

DirectLight::Path DirectLight::SamplePath(const LightGroup& group, const Receiver& receiver) const
{
  const double distance = glm::length(group.Centre - receiver.Point);
  if (!(distance > 0.0))
  {
    return {0.0, 1.0};
  }
  const double depth = this->Depth(receiver, group.Centre);
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

void DirectLight::AddPoint(
  const LightGroup& group, const Receiver& receiver, const Path& path, Spectrum& sum) const
{
  const Vec3 to = group.Centre - receiver.Point;
  const double square = glm::dot(to, to);
  const double distance = std::sqrt(square);
  const double cosine = -glm::dot(to, group.Normal) / distance;
  if (cosine <= 0.0)
  {
    return;
  }
  double factor = path.Visible * cosine / square;
  factor *= group.Law.Relative(-to / distance, cosine);
  if (receiver.Normal)
  {
    factor *= std::max(0.0, glm::dot(to, *receiver.Normal) / distance);
  }
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    sum[band] += factor * group.Intensity[band] *
                 std::exp(-this->Scene_.ExtinctionScale(band) * path.MeanExtinction * distance);
  }
}

void DirectLight::AddLeaf(
  const LightGroup& leaf, const Receiver& receiver, const Path& path, Spectrum& sum) const
{
  const Vec3& point = receiver.Point;
  const std::array<Vec3, 4>& corners = leaf.Corners;
  const double closed = receiver.Normal ? ProjectedSolidAngle(point, *receiver.Normal, corners)
                                        : SolidAngle(point, corners);
  // Mean of transmittance and of cos^n over the leaf, weighted as its light is.
  const double toCentre = glm::length(leaf.Centre - point);
  const bool few = leaf.Radius < PathRatio * toCentre;
  // Where a shadow's edge crosses the leaf, what hides and what dims go together place by place.
  const bool parted = !few && path.Visible < 1.0;
  // Two points an edge follow what changes little, and more of it from afar: their error goes with
  // the square of the leaf's size over its distance.
  const double steep = std::min(1.0, leaf.Radius / (LeafRatio * toCentre));
  const bool thin =
    leaf.Law == EmissionLaw() && steep * this->ChangeOver(leaf, receiver) < EvenDepth;
  double weights = 0.0;
  Spectrum weighted{};
  const auto add = [&](double u, double v, double share, bool seen)
  {
    const Vec3 target = leaf.At(u, v);
    const Vec3 to = target - point;
    const double square = glm::dot(to, to);
    const double distance = std::sqrt(square);
    const double cosine = std::max(0.0, -glm::dot(to, leaf.Normal) / distance);
    double weight = share * leaf.AreaAt(u, v) * cosine / square;
    if (receiver.Normal)
    {
      weight *= std::max(0.0, glm::dot(to, *receiver.Normal) / distance);
    }
    weights += weight;
    if (!seen)
    {
      return;
    }
    weight *= leaf.Law.Relative(-to / distance, cosine);
    const double depth = few ? path.MeanExtinction * distance : this->Depth(receiver, target);
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      weighted[band] += weight * std::exp(-this->Scene_.ExtinctionScale(band) * depth);
    }
  };
  if (parted)
  {
    const std::span<const glm::dvec2> places = LightSight::Lattice();
    const std::vector<bool> seen = this->Sight_.Seen(leaf, point, places);
    for (std::size_t i = 0; i < seen.size(); ++i)
    {
      add(places[i].x, places[i].y, 1.0, seen[i]);
    }
  }
  else if (few || thin)
  {
    for (const double u : Nodes2)
    {
      for (const double v : Nodes2)
      {
        add(u, v, 1.0, true);
      }
    }
  }
  else
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        add(Nodes3[i], Nodes3[j], Weights3[i] * Weights3[j], true);
      }
    }
  }
  if (!(weights > 0.0))
  {
    return;
  }
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    sum[band] += (parted ? 1.0 : path.Visible) * leaf.Intensity[band] / leaf.Area * closed *
                 weighted[band] / weights;
  }
}

bool DirectLight::AddStencil(
  const LightGroup& group, const Receiver& receiver, const Path* path, Spectrum& sum) const
{
  const Vec3 centre = group.Centre - receiver.Point;
  // Neither the plane of the plate nor the receiver's horizon may cut the group.
  if (!group.Stencil || glm::dot(centre, group.Normal) >= 0.0 ||
      (receiver.Normal && glm::dot(centre, *receiver.Normal) < group.Radius) ||
      this->ChangeOver(group, receiver) > StencilDepth)
  {
    return false;
  }
  const auto places = group.Stencil->PlacesFor(receiver.Point, group.Law.Sharpness());
  if (places.empty())
  {
    return false;
  }
  if (path == nullptr && !receiver.Clear)
  {
    const auto seen = std::count_if(places.begin(), places.end(),
      [&](const PlateStencil::Place& place)
      { return this->Scene_.Shapes().Visible(receiver.Point, place.Point); });
    if (seen < static_cast<std::ptrdiff_t>(places.size()))
    {
      return seen == 0;
    }
  }
  for (const PlateStencil::Place& place : places)
  {
    const Vec3 to = place.Point - receiver.Point;
    const double square = glm::dot(to, to);
    const double distance = std::sqrt(square);
    const double cosine = -glm::dot(to, group.Normal) / distance;
    double factor = (path ? path->Visible : 1.0) * cosine / square;
    factor *= group.Law.Relative(-to / distance, cosine);
    if (receiver.Normal)
    {
      factor *= glm::dot(to, *receiver.Normal) / distance;
    }
    const double depth =
      path ? path->MeanExtinction * distance : this->Depth(receiver, place.Point);
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sum[band] +=
        factor * place.Intensity[band] * std::exp(-this->Scene_.ExtinctionScale(band) * depth);
    }
  }
  return true;
}

void DirectLight::Gather(const LightGroup& group, const Receiver& receiver, const Path* path,
  int splits, Spectrum& sum) const
{
  const Vec3 to = group.Centre - receiver.Point;
  const double height = -glm::dot(to, group.Normal);
  const bool leaf = group.FirstChild < 0;
  if (height <= (leaf ? 0.0 : -group.Radius) ||
      (receiver.Normal && glm::dot(to, *receiver.Normal) <= -group.Radius) ||
      InOnePlane(group, height, receiver.Normal))
  {
    return;
  }
  const double ratio = group.Radius / glm::length(to);
  const double steep = ratio * group.Law.LeafSharpness();
  // A leaf that the receiver's horizon cuts is split until the rest does not matter.
  const bool cut = leaf && splits > 0 && receiver.Normal && ratio > CutRatio &&
                   std::abs(glm::dot(to, *receiver.Normal)) < group.Radius;
  Path own;
  // Where nothing but thin smoke lies before a Lambertian leaf, its closed form needs no parts.
  const bool even = leaf && receiver.Clear && !receiver.Normal && group.Law == EmissionLaw() &&
                    this->ChangeOver(group, receiver) < EvenDepth;
  const bool last = leaf && (splits == 0 || even);
  if (path == nullptr && (ratio < PathRatio || (leaf && steep < LeafRatio) || last))
  {
    own = this->SamplePath(group, receiver);
    path = &own;
  }
  if (path != nullptr && path->Visible == 0.0)
  {
    return;
  }
  if (steep < (leaf ? LeafPointRatio : PointRatio))
  {
    this->AddPoint(group, receiver, *path, sum);
  }
  else if (leaf && !cut && (steep < LeafRatio || last))
  {
    this->AddLeaf(group, receiver, *path, sum);
  }
  else if (leaf)
  {
    // A slender leaf is cut across alone.
    const double along = glm::length(group.Corners[1] - group.Corners[0]);
    const double up = glm::length(group.Corners[3] - group.Corners[0]);
    const int columns = up > SlenderRatio * along ? 1 : 2;
    const int rows = along > SlenderRatio * up ? 1 : 2;
    const int left = std::max(0, splits - (columns * rows == 4 ? SplitInFour : 1));
    for (int column = 0; column < columns; ++column)
    {
      for (int row = 0; row < rows; ++row)
      {
        const LightGroup part = Part(group, static_cast<double>(column) / columns,
          (column + 1.0) / columns, static_cast<double>(row) / rows, (row + 1.0) / rows);
        this->Gather(part, receiver, path, left, sum);
      }
    }
  }
  else if (!this->AddStencil(group, receiver, path, sum))
  {
    const auto& groups = this->Scene_.Lights().Groups();
    this->Gather(groups[group.FirstChild], receiver, path, splits, sum);
    this->Gather(groups[group.FirstChild + 1], receiver, path, splits, sum);
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
  return this->Fluence(light, receiver);
}

Spectrum DirectLight::Fluence(std::size_t light, const Receiver& receiver) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  Spectrum sum{};
  this->Gather(root, receiver, nullptr, SplitsOf(root.Law), sum);
  return sum;
}

Spectrum DirectLight::Illuminance(
  std::size_t light, const Vec3& point, const Vec3& normal, bool clear) const
{
  Spectrum sum{};
  const LightGroup& root = this->Scene_.Lights().Root(light);
  this->Gather(root, {point, normal, clear}, nullptr, SplitsOf(root.Law), sum);
  return sum;
}

} // namespace smokevis
