// DirectLight's part for the leaves of a light and their groups, as a point gets them.
#include "DirectLight.h"

#include "GaussNodes.h"
#include "PolygonClip.h"
#include "PolygonLight.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// A group of radius r at a distance d acts as one point below this r/d: the error is of the order
/// (r/d)^2. A leaf has a closed form, so it turns into a point only where that costs digits no
/// more.
constexpr double PointRatio = 1.0 / 32.0;
constexpr double LeafPointRatio = 1.0 / 128.0;
/// How often a leaf is split above LeafRatio: in four, which counts three times, or in two where
/// one edge is so many times the other.
constexpr int LeafSplits = 12;
/// The same where light goes as a power of the cosine, which no few points follow close to a leaf:
/// parts are split down to their distance.
constexpr int SteepLeafSplits = 66;
constexpr int SplitInFour = 3;
constexpr double SlenderRatio = 1.517;
/// LeafRatio for what a horizon leaves of a leaf, however sharp its law.
constexpr double CutLeafRatio = 0.3;
/// Above this r/d a leaf that a receiver's horizon cuts counts as what is above it.
constexpr double CutRatio = 0.02;
/// Optical depth across a leaf below which its transmittance is known however close it is.
constexpr double EvenDepth = 0.04;
/// The same before a surface: close to the leaf it gets most from what is closest.
constexpr double EvenReceiverDepth = 0.01;
/// Optical depth across the radius of a group above which its light does not go smoothly enough for
/// the few places of a stencil.
constexpr double StencilDepth = 1.0;

int SplitsOf(const EmissionLaw& law)
{
  return law.Lambertian() ? LeafSplits : SteepLeafSplits;
}

/// The part of a leaf with these corners; a triangle repeats its last one.
LightGroup PartOf(const LightGroup& leaf, const std::array<Vec3, 4>& corners)
{
  LightGroup part = leaf;
  part.Corners = corners;
  part.Centre = part.At(0.5, 0.5);
  part.Radius = 0.0;
  for (const Vec3& corner : part.Corners)
  {
    part.Radius = std::max(part.Radius, glm::length(corner - part.Centre));
  }
  part.Area = 0.5 * glm::length(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
  for (double& intensity : part.Intensity)
  {
    intensity *= part.Area / leaf.Area;
  }
  return part;
}

LightGroup Part(const LightGroup& leaf, double u0, double u1, double v0, double v1)
{
  return PartOf(leaf, {leaf.At(u0, v0), leaf.At(u1, v0), leaf.At(u1, v1), leaf.At(u0, v1)});
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
  // A plane leaf's area for each unit of u and v changes in proportion to them.
  const Vec3 along = corners[1] - corners[0];
  const Vec3 up = corners[3] - corners[0];
  const Vec3 twist = corners[2] - corners[3] - along;
  const double area = glm::dot(leaf.Normal, glm::cross(along, up));
  const double areaAlong = glm::dot(leaf.Normal, glm::cross(along, twist));
  const double areaUp = glm::dot(leaf.Normal, glm::cross(twist, up));
  double weights = 0.0;
  Spectrum weighted{};
  const auto add = [&](double u, double v, double share, bool seen)
  {
    const Vec3 target = corners[0] + u * along + v * (up + u * twist);
    const Vec3 to = target - point;
    const double square = glm::dot(to, to);
    const double distance = std::sqrt(square);
    const double cosine = std::max(0.0, -glm::dot(to, leaf.Normal) / distance);
    double weight = share * std::abs(area + u * areaAlong + v * areaUp) * cosine / square;
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
    const double depth =
      few ? path.MeanExtinction * distance : this->Depth(receiver, target, distance);
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
  Spectrum own{};
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
      path ? path->MeanExtinction * distance : this->Depth(receiver, place.Point, distance);
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      own[band] +=
        factor * place.Intensity[band] * std::exp(-this->Scene_.ExtinctionScale(band) * depth);
    }
  }
  // Some places take light away: where smoke ends between them, more than there is.
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    sum[band] += std::max(0.0, own[band]);
  }
  return true;
}

bool DirectLight::AddAboveHorizon(const LightGroup& leaf, const Receiver& receiver,
  const Path* path, int splits, Spectrum& sum) const
{
  const auto height = [&receiver](const Vec3& corner)
  { return glm::dot(corner - receiver.Point, *receiver.Normal); };
  const std::array<double, 4> heights = {height(leaf.Corners[0]), height(leaf.Corners[1]),
    height(leaf.Corners[2]), height(leaf.Corners[3])};
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double none = PlaneShare * leaf.Radius;
  if (*lowest >= -none || *highest <= none)
  {
    return *highest <= none;
  }
  thread_local std::vector<Vec3> leafCorners;
  thread_local std::vector<Vec3> above;
  leafCorners.assign(leaf.Corners.begin(), leaf.Corners.end());
  KeepSide(leafCorners, height, above);
  // A fan of quadrilaterals: two at most, since at most five corners are left.
  std::array<LightGroup, 2> parts;
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < above.size() && count < parts.size(); i += 2)
  {
    const Vec3& last = above[std::min(i + 2, above.size() - 1)];
    parts[count] = PartOf(leaf, {above[0], above[i], above[i + 1], last});
    count += parts[count].Area > 0.0 ? 1 : 0;
  }
  Receiver uncut = receiver;
  uncut.Cuts = false;
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Gather(parts[i], uncut, path, splits, sum);
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
  const double distance = glm::length(to);
  const double ratio = group.Radius / distance;
  const double steep = ratio * group.Law.LeafSharpness();
  // What a horizon has cut fades towards it, in a part that may be any quadrilateral.
  bool close = steep >= LeafRatio || (!receiver.Cuts && ratio >= CutLeafRatio);
  bool faint = false;
  if (leaf && close)
  {
    const double coarseness = group.Law.Coarseness(height, distance - group.Radius);
    faint = std::isinf(coarseness);
    close = coarseness == 1.0 || steep >= coarseness * LeafRatio;
  }
  if (leaf && receiver.Normal && receiver.Cuts && ratio > CutRatio &&
      std::abs(glm::dot(to, *receiver.Normal)) < group.Radius &&
      this->AddAboveHorizon(group, receiver, path, splits, sum))
  {
    return;
  }
  Path own;
  // Where nothing but thin smoke lies before a Lambertian leaf, its closed form needs no parts.
  const bool even =
    leaf && receiver.Clear && group.Law == EmissionLaw() &&
    this->ChangeOver(group, receiver) < (receiver.Normal ? EvenReceiverDepth : EvenDepth);
  const bool last = leaf && (splits == 0 || even || faint);
  if (path == nullptr && (ratio < PathRatio || (leaf && !close) || last))
  {
    own = this->SamplePath(group, receiver);
    path = &own;
  }
  if (path != nullptr && path->Visible == 0.0)
  {
    return;
  }
  if (faint || steep < (leaf ? LeafPointRatio : PointRatio))
  {
    this->AddPoint(group, receiver, *path, sum);
  }
  else if (leaf && (!close || last))
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

Spectrum DirectLight::Fluence(std::size_t light, const Receiver& receiver) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  Spectrum sum{};
  this->Gather(root, receiver, nullptr, SplitsOf(root.Law), sum);
  return sum;
}

Spectrum DirectLight::Illuminance(std::size_t light, const Vec3& point, const Vec3& normal) const
{
  return this->Fluence(light, Receiver{point, normal});
}

} // namespace smokevis
