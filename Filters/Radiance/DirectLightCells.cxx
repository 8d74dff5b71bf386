// DirectLight's part for smoke cells: means over cells, and the ways that a block of them shares.
#include "DirectLight.h"

#include "GaussNodes.h"
#include "NearLights.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

/// Cells along the edges of the smallest block in which ways tell of each other, error of an
/// optical depth that is told so, and where in the block it is measured.
constexpr int SmallestBlock = 4;
constexpr double WayTolerance = 0.004;
constexpr std::array<std::array<double, 3>, 3> WayChecks = {
  {{0.5, 0.5, 0.5}, {0.25, 0.7, 0.3}, {0.75, 0.3, 0.65}}};
/// Share of the fluence of the other lights that all lights left out may add: single precision
/// does not show it.
constexpr double NegligibleShare = 1e-7;
/// Share of the fluence of the other lights below which the mean of a light over a box is taken
/// without Gauss points: it is known to a few percent, so that single precision in a sum of all is
/// not needed of it.
constexpr double WeakShare = 0.05;
constexpr double Infinity = std::numeric_limits<double>::infinity();
/// A box as large as this share of its distance to the light is split.
constexpr double BoxRatio = 0.5;
constexpr int BoxSplits = 3;
/// A box of a larger optical depth, or larger share of its distance, is measured at Gauss points:
/// two along each edge follow an exponential over a depth x to x^4 / 4320, three go farther. Above
/// the deepest nearly all light stays in the first part of the box.
constexpr double FlatDepth = 0.25;
constexpr double FlatRatio = 0.2;
constexpr double TwoPointDepth = 1.2;
constexpr double DeepestGauss = 4.0;

/// Where a cell lies between the first and the last of its block, 0 to 1.
Vec3 BlockShare(const Medium::Block& block, const std::array<int, 3>& place)
{
  Vec3 share(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    share[axis] =
      block.Size[axis] > 1 ? static_cast<double>(place[axis]) / (block.Size[axis] - 1) : 0.0;
  }
  return share;
}

/// Value between those at the corners of a box, first axis fastest.
double Trilinear(const std::array<double, 8>& corners, const Vec3& share)
{
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    sum += corners[corner] * (corner & 1 ? share.x : 1.0 - share.x) *
           (corner & 2 ? share.y : 1.0 - share.y) * (corner & 4 ? share.z : 1.0 - share.z);
  }
  return sum;
}

/// Mean place of exp(-2 x t) over t in (-1/2, 1/2), times -2: coth x - 1 / x.
double Langevin(double x)
{
  return std::abs(x) < 1e-3 ? x / 3.0 : 1.0 / std::tanh(x) - 1.0 / x;
}

/// Mean of exp(-2 x t) over t in (-1/2, 1/2), over its value at t = -shift / 2.
double MeanAttenuation(double x, double shift)
{
  const double size = std::abs(x);
  const double logarithm =
    size < 1e-3 ? size * size / 6.0 : size + std::log(-std::expm1(-2.0 * size) / (2.0 * size));
  return std::exp(logarithm - x * shift);
}

struct GaussPlace
{
  Vec3 Point;
  double Weight;
};

/// Gauss places in a box, so many along each edge (2 or 3).
std::vector<GaussPlace> GaussPlaces(const Vec3& centre, const Vec3& size, int order)
{
  std::vector<GaussPlace> places;
  places.reserve(static_cast<std::size_t>(order) * order * order);
  for (int point = 0; point < order * order * order; ++point)
  {
    const std::array<int, 3> index = {
      point % order, point / order % order, point / (order * order)};
    double weight = 1.0;
    Vec3 share;
    for (int axis = 0; axis < 3; ++axis)
    {
      share[axis] = order == 2 ? Nodes2[index[axis]] : Nodes3[index[axis]];
      weight *= order == 2 ? 0.5 : Weights3[index[axis]];
    }
    places.push_back({centre + (share - 0.5) * size, weight});
  }
  return places;
}

/// What a light that were a point would send along a way, over its luminous intensity.
double PointLight(const LightGroup& light, const Vec3& way)
{
  const double square = glm::dot(way, way);
  const double distance = std::sqrt(square);
  const double cosine = glm::dot(way, light.Normal) / distance;
  return cosine / square * light.Law.Relative(way / distance, cosine);
}

} // namespace

bool DirectLight::Clear(std::size_t light, std::int64_t cell) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  const LightGroup& root = lights.Groups()[lights.Lights()[light]];
  if (const CellPart* part = this->Scene_.Smoke().Parts().Find(cell))
  {
    return std::all_of(part->Fine.begin(), part->Fine.end(),
      [&](const PartSample& sample)
      { return this->VisibleShare(root, part->Centre + Vec3(sample.Offset)) == 1.0; });
  }
  const Vec3 centre = this->Scene_.Smoke().CellCentre(cell);
  const Vec3 size = this->Scene_.Smoke().CellSize(cell);
  // Slightly inside, since cells often end at walls.
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 shift(
      corner & 1 ? 0.49 : -0.49, corner & 2 ? 0.49 : -0.49, corner & 4 ? 0.49 : -0.49);
    if (this->VisibleShare(root, centre + shift * size) < 1.0)
    {
      return false;
    }
  }
  return this->VisibleShare(root, centre) == 1.0;
}

Spectrum DirectLight::CellFluence(std::size_t light, std::int64_t cell) const
{
  const Medium& smoke = this->Scene_.Smoke();
  if (const CellPart* part = smoke.Parts().Find(cell))
  {
    return this->PartFluence(light, *part);
  }
  const EmitterSet& lights = this->Scene_.Lights();
  const LightGroup& root = lights.Groups()[lights.Lights()[light]];
  const Vec3 centre = smoke.CellCentre(cell);
  const Vec3 size = smoke.CellSize(cell);
  BoxLight box{light};
  const int near = this->Near_ ? this->Near_->Place(cell) : -1;
  if (near >= 0)
  {
    const std::vector<NearLights::Light>& lightsThere = this->Near_->Cells()[near].Lights;
    const auto found = std::find_if(lightsThere.begin(), lightsThere.end(),
      [light](const NearLights::Light& there) { return there.Index == light; });
    if (found != lightsThere.end())
    {
      box.Clear = found->Clear;
      // In the thickest cells light does not follow what is interpolated.
      box.Near = found->Clear && this->BoxDepth(centre, size) < DeepestGauss
                   ? this->Near_->Field(light)
                   : nullptr;
      return this->BoxFluence(box, centre, size, BoxSplits);
    }
  }
  const bool splits =
    std::max({size.x, size.y, size.z}) * root.Law.Sharpness() > BoxRatio * root.Distance(centre);
  box.Clear = splits && this->Clear(light, cell);
  return this->BoxFluence(box, centre, size, BoxSplits);
}

Spectrum DirectLight::PartFluence(std::size_t light, const CellPart& part) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const EmitterSet& lights = this->Scene_.Lights();
  const LightGroup& root = lights.Groups()[lights.Lights()[light]];
  const double distance = root.Distance(part.Centre);
  const double edge = std::max({part.Size.x, part.Size.y, part.Size.z});
  const double steep = edge * root.Law.Sharpness();
  const double depth = smoke.Extinction(part.Cell) * this->Scene_.LargestScale() * edge;
  Spectrum sum{};
  const auto add = [&](const Vec3& point, double share, bool clear)
  {
    const Spectrum value = this->Fluence(light, point, clear);
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sum[band] += share * value[band];
    }
  };
  if (steep > BoxRatio * distance)
  {
    // As fine as whole cells are cut beside a light: the middles of the boxes that lie in the part.
    int boxes = 4;
    while (boxes < 1 << BoxSplits && steep > 2.0 * BoxRatio * distance)
    {
      boxes *= 2;
    }
    const Box bounds = smoke.BoxOf(part.Cell);
    const Vec3 size = bounds.Upper - bounds.Lower;
    std::vector<Vec3> inside;
    for (int i = 0; i < boxes * boxes * boxes; ++i)
    {
      const Vec3 place(i % boxes, i / boxes % boxes, i / (boxes * boxes));
      const Vec3 point = bounds.Lower + (place + 0.5) / static_cast<double>(boxes) * size;
      if (smoke.Parts().Locate(part.Cell, point) == part.Number)
      {
        inside.push_back(point);
      }
    }
    if (inside.size() >= part.Fine.size())
    {
      const bool clear = this->Clear(light, part.Number);
      for (const Vec3& point : inside)
      {
        add(point, 1.0 / static_cast<double>(inside.size()), clear);
      }
      return sum;
    }
  }
  const bool flat = depth < FlatDepth && steep < FlatRatio * distance;
  for (const PartSample& sample : flat ? part.Coarse : part.Fine)
  {
    add(part.Centre + Vec3(sample.Offset), sample.Share, false);
  }
  return sum;
}

double DirectLight::WayExtinction(const LightGroup& root, std::int64_t cell) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Vec3 from = smoke.CellCentre(cell);
  const double distance = glm::length(root.Centre - from);
  return smoke.OpticalDepth(from, (root.Centre - from) / distance, 0.0, distance) / distance;
}

double DirectLight::LargestShare(const LightGroup& root, const Medium::Block& block,
  const std::array<double, 8>& ways, const std::vector<Spectrum>& sums) const
{
  if (root.Law.Measured())
  {
    return Infinity;
  }
  const Medium& smoke = this->Scene_.Smoke();
  // No cell gets more than all of the plate would send it from the nearest place of the block.
  const Vec3 low = smoke.CellCentre(smoke.Cell(block, {0, 0, 0}));
  const Vec3 high =
    smoke.CellCentre(smoke.Cell(block, {block.Size[0] - 1, block.Size[1] - 1, block.Size[2] - 1}));
  const double reach = 0.5 * glm::length(high - low) + root.Radius;
  const double distance = glm::length(root.Centre - 0.5 * (low + high)) - reach;
  if (!(distance > reach))
  {
    return Infinity;
  }
  const double depth = *std::min_element(ways.begin(), ways.end()) * distance - WayTolerance;
  Spectrum most{};
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    most[band] = root.Intensity[band] / (distance * distance) *
                 std::exp(-this->Scene_.ExtinctionScale(band) * depth);
  }
  double share = 0.0;
  std::array<int, 3> place;
  for (place[2] = 0; place[2] < block.Size[2]; ++place[2])
  {
    for (place[1] = 0; place[1] < block.Size[1]; ++place[1])
    {
      for (place[0] = 0; place[0] < block.Size[0]; ++place[0])
      {
        const std::int64_t cell = smoke.Cell(block, place);
        for (int band = 0; band < this->Scene_.Bands(); ++band)
        {
          share = most[band] > 0.0 ? std::max(share, most[band] / sums[cell][band]) : share;
        }
      }
    }
  }
  return share;
}

std::optional<DirectLight::Told> DirectLight::BlockWays(
  const LightGroup& root, const Medium::Block& block, const std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const auto cornerCell = [&](int corner)
  {
    return smoke.Cell(
      block, {corner & 1 ? block.Size[0] - 1 : 0, corner & 2 ? block.Size[1] - 1 : 0,
               corner & 4 ? block.Size[2] - 1 : 0});
  };
  const Vec3 low = smoke.CellCentre(cornerCell(0));
  const Vec3 high = smoke.CellCentre(cornerCell(7));
  const double distance =
    glm::length(root.Centre - 0.5 * (low + high)) - 0.5 * glm::length(high - low);
  const Vec3 size = smoke.CellSize(cornerCell(0));
  const double edge = std::max({size.x, size.y, size.z}) * root.Law.Sharpness();
  if (!(root.Radius < PathRatio * distance) || glm::length(high - low) > BoxRatio * distance ||
      edge > 0.5 * BoxRatio * distance)
  {
    return std::nullopt;
  }
  Told told;
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::int64_t cell = cornerCell(corner);
    // Solids hold no smoke, so that ways out of them do not tell of their neighbours.
    if (smoke.Extinction(cell) == 0.0F && smoke.MaximumExtinction() > 0.0F)
    {
      return std::nullopt;
    }
    told.Ways[corner] = this->WayExtinction(root, cell);
  }
  told.Share = this->LargestShare(root, block, told.Ways, sums) *
               static_cast<double>(this->Scene_.Lights().Lights().size());
  const double allowed = WayTolerance * std::max(1.0, 1.0 / told.Share);
  const double scale = this->Scene_.LargestScale();
  for (const auto& share : WayChecks)
  {
    std::array<int, 3> place;
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = static_cast<int>(share[axis] * block.Size[axis]);
    }
    const std::int64_t cell = smoke.Cell(block, place);
    const double there = Trilinear(told.Ways, BlockShare(block, place));
    const double way = glm::length(root.Centre - smoke.CellCentre(cell));
    if (std::abs(there - this->WayExtinction(root, cell)) * way * scale > allowed)
    {
      return std::nullopt;
    }
  }
  return told;
}

DirectLight::BlockWork DirectLight::AddBlockFluence(
  std::size_t light, const Medium::Block& block, bool skips, std::vector<Spectrum>& sums) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  const Medium& smoke = this->Scene_.Smoke();
  const LightGroup& root = lights.Groups()[lights.Lights()[light]];
  const int largest = std::max({block.Size[0], block.Size[1], block.Size[2]});
  std::optional<Told> told;
  if (skips && largest >= SmallestBlock)
  {
    told = this->BlockWays(root, block, sums);
  }
  BlockWork work;
  if (!told && largest > SmallestBlock)
  {
    const int half = (largest + 1) / 2;
    for (int part = 0; part < 8; ++part)
    {
      Medium::Block child = block;
      bool empty = false;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int first = part >> axis & 1 ? half : 0;
        child.First[axis] += first;
        child.Size[axis] = std::min(half, block.Size[axis] - first);
        empty = empty || child.Size[axis] <= 0;
      }
      if (!empty)
      {
        const BlockWork own = this->AddBlockFluence(light, child, skips, sums);
        work.Told += own.Told;
        work.Negligible += own.Negligible;
      }
    }
    return work;
  }
  if (told && told->Share < NegligibleShare)
  {
    work.Negligible = static_cast<std::size_t>(block.Size[0]) * block.Size[1] * block.Size[2];
    return work;
  }
  std::array<int, 3> place;
  for (place[2] = 0; place[2] < block.Size[2]; ++place[2])
  {
    for (place[1] = 0; place[1] < block.Size[1]; ++place[1])
    {
      for (place[0] = 0; place[0] < block.Size[0]; ++place[0])
      {
        const std::int64_t cell = smoke.Cell(block, place);
        if (smoke.Parts().Find(cell))
        {
          // The parts of a cell are measured each by itself.
          continue;
        }
        const Spectrum value =
          told ? this->BoxFluence({light, false, Trilinear(told->Ways, BlockShare(block, place)),
                                    told->Share < WeakShare},
                   smoke.CellCentre(cell), smoke.CellSize(cell), 0)
               : this->CellFluence(light, cell);
        work.Told += told ? 1 : 0;
        for (int band = 0; band < this->Scene_.Bands(); ++band)
        {
          sums[cell][band] += value[band];
        }
      }
    }
  }
  return work;
}

Spectrum DirectLight::Fluence(const BoxLight& light, const Vec3& point) const
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
  return light.Extinction ? this->Fluence(light.Index,
                              Receiver{point, std::nullopt, light.Clear, {}, light.Extinction})
                          : this->Fluence(light.Index, point, light.Clear);
}

Spectrum DirectLight::BoxFluence(
  const BoxLight& light, const Vec3& centre, const Vec3& size, int splits) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  const LightGroup& root = lights.Groups()[lights.Lights()[light.Index]];
  const Vec3 from = centre - root.Centre;
  const double toCentre = glm::length(from);
  const double distance = root.Distance(centre);
  const double edge = std::max({size.x, size.y, size.z}) * root.Law.Sharpness();
  if (splits > 0 && edge > BoxRatio * distance)
  {
    // A box wholly behind the plate gets nothing.
    if (glm::dot(from, root.Normal) + 0.5 * glm::length(size) < -root.Radius)
    {
      return {};
    }
    Spectrum sum{};
    for (int part = 0; part < 8; ++part)
    {
      const Vec3 shift(part & 1 ? 0.25 : -0.25, part & 2 ? 0.25 : -0.25, part & 4 ? 0.25 : -0.25);
      const Spectrum value = this->BoxFluence(light, centre + shift * size, 0.5 * size, splits - 1);
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
  const double depth = this->BoxDepth(centre, size);
  if (!close && !light.Weak && depth < DeepestGauss &&
      (depth > FlatDepth || edge > FlatRatio * distance))
  {
    return this->GaussFluence(light, centre, size);
  }
  // Mean over the box. Along the light exp(-K s) is exact; its mean lies at a place of its own,
  // where the rest of the light's variation is taken.
  const Vec3 along = toCentre > root.Radius ? from / toCentre : root.Normal;
  const std::int64_t cell = this->Scene_.Smoke().Locate(centre);
  const double extinction =
    cell < 0 ? 0.0 : this->Scene_.Smoke().Extinction(cell) * this->Scene_.ExtinctionScale(0);
  Vec3 place = middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] -= 0.5 * extent[axis] * Langevin(0.5 * extinction * along[axis] * extent[axis]);
  }
  Spectrum value = this->Fluence(light, place);
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
    const double k = extinction * this->Scene_.ExtinctionScale(band) /
                     std::max(1e-300, this->Scene_.ExtinctionScale(0));
    // Off its axis a way is longer: second derivatives of the distance.
    double longer = 0.0;
    for (int axis = 0; axis < 3 && !close; ++axis)
    {
      longer += extent[axis] * extent[axis] * (1.0 - along[axis] * along[axis]) / (24.0 * toCentre);
    }
    double factor = lit * curvature * std::exp(-k * longer);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double half = 0.5 * k * along[axis] * extent[axis];
      const double first = 0.5 * extinction * along[axis] * extent[axis];
      factor *= MeanAttenuation(half, Langevin(first));
    }
    value[band] *= factor;
  }
  return value;
}

double DirectLight::BoxDepth(const Vec3& centre, const Vec3& size) const
{
  const std::int64_t cell = this->Scene_.Smoke().Locate(centre);
  return cell < 0 ? 0.0
                  : this->Scene_.Smoke().Extinction(cell) * this->Scene_.LargestScale() *
                      std::max({size.x, size.y, size.z});
}

Spectrum DirectLight::GaussFluence(
  const BoxLight& light, const Vec3& centre, const Vec3& size) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  const LightGroup& root = lights.Groups()[lights.Lights()[light.Index]];
  const Vec3 from = centre - root.Centre;
  const double toCentre = glm::length(from);
  const std::vector<GaussPlace> places =
    GaussPlaces(centre, size, this->BoxDepth(centre, size) < TwoPointDepth ? 2 : 3);
  Spectrum sum{};
  if (!(root.Radius * root.Law.Sharpness() < PathRatio * toCentre))
  {
    for (const GaussPlace& place : places)
    {
      const Spectrum value = this->Fluence(light, place.Point);
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        sum[band] += place.Weight * value[band];
      }
    }
    return sum;
  }
  // Ways to the places in the box differ from the one to its centre inside the box alone.
  Receiver receiver{centre, std::nullopt, light.Clear, {}, light.Extinction};
  const Path path = this->SamplePath(root, receiver);
  if (path.Visible == 0.0)
  {
    return {};
  }
  const std::int64_t cell = this->Scene_.Smoke().Locate(centre);
  const double extinction = cell < 0 ? 0.0 : this->Scene_.Smoke().Extinction(cell);
  const double depth = path.MeanExtinction * toCentre;
  const auto depthAt = [&](double distance)
  { return std::max(0.0, depth + extinction * (distance - toCentre)); };
  receiver.Clear = true;
  const double height = glm::dot(from, root.Normal);
  if (height > glm::dot(glm::abs(root.Normal), size) && root.Plane())
  {
    // That the light is no point matters as much at one place of the box as at another: places
    // differ from the centre as they would before a point.
    receiver.Extinction = path.MeanExtinction;
    sum = this->Fluence(light.Index, receiver);
    const double atCentre = PointLight(root, from);
    Spectrum mean{};
    for (const GaussPlace& place : places)
    {
      const Vec3 way = place.Point - root.Centre;
      const double weight = place.Weight * PointLight(root, way) / atCentre;
      const double further = depthAt(glm::length(way)) - depth;
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        mean[band] += weight * std::exp(-this->Scene_.ExtinctionScale(band) * further);
      }
    }
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sum[band] *= path.Visible * mean[band];
    }
    return sum;
  }
  for (const GaussPlace& place : places)
  {
    const double distance = glm::length(root.Centre - place.Point);
    receiver.Point = place.Point;
    receiver.Extinction = depthAt(distance) / distance;
    const Spectrum value = this->Fluence(light.Index, receiver);
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sum[band] += path.Visible * place.Weight * value[band];
    }
  }
  return sum;
}

} // namespace smokevis
