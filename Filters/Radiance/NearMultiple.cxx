#include "NearMultiple.h"

#include "GaussNodes.h"
#include "NearLights.h"
#include "Sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smokevis
{

namespace
{

/// Least share of a cell's light that the smoke beside a close light sends there, where cells are
/// looked at: optical depth of scattering across the cell, times the light's share. The veil right
/// before the light is off by about half of this share of itself otherwise.
constexpr double LeastShare = 0.1;
/// Optical depth of scattering across a cell above which light varies too much between the places.
constexpr double MostDepth = 1.0;
/// Rays to each place for each batch. All places have the same directions, so that noise hardly
/// changes their ratios: by 2 %.
constexpr int RaysABatch = 2;
/// Of the directions, which are the same in all cells: numbers of cells tell nothing of a scene.
constexpr std::uint64_t DirectionsKey = 1;

/// Share of a cell below or above the plane of a plate up to which the plane counts as a face.
constexpr double LeastPart = 0.15;

/// Places along each axis of a part of a cell, and of a whole one. Parts are what plates leave that
/// are smaller than the cell, and their bars narrower. In whole cells before such a sign three
/// would follow the gathered light more closely, but that is of means over cells, and too low on
/// the sign's axis (by 10 to 20 % in cells of half a mean free path): two make up for it.
constexpr int PartPlaces = 3;
constexpr int WholePlaces = 2;

/// One of the places, as shares of the cell along each axis: the weighted mean over two along each
/// is that over the cell of what varies up to the third power, over three up to the fifth.
Vec3 ShareOf(int place, int along)
{
  const double* const nodes = along == 2 ? Nodes2.data() : Nodes3.data();
  return {nodes[place % along], nodes[place / along % along], nodes[place / (along * along)]};
}

double WeightOf(int place, int along)
{
  return along == 2 ? 0.125 : Weights3[place % 3] * Weights3[place / 3 % 3] * Weights3[place / 9];
}

/// What each of the places along an axis counts at a share of it: a straight line, or a quadratic.
std::array<double, 3> WeightsAt(double share, int along)
{
  if (along == 3)
  {
    return QuadraticWeights(share);
  }
  const double upper = (share - Nodes2[0]) / (Nodes2[1] - Nodes2[0]);
  return {1.0 - upper, upper, 0.0};
}

} // namespace

double NearMultiple::Cut::Below(const Vec3& share) const
{
  return this->Axis < 0 ? 1.0
                        : std::clamp(this->Middle + glm::dot(this->Slopes, share - 0.5), 0.0, 1.0);
}

NearMultiple::NearMultiple(const IndirectLight& light) : Light_(light)
{
  const Scene& scene = light.TheScene();
  const LightField& field = light.Field();
  const double scale = scene.Albedo() * scene.ExtinctionScale(light.Band());
  if (scene.Smoke().Empty() || scale == 0.0)
  {
    return;
  }
  const NearLights& lights = scene.Near(field.Tolerance);
  this->Lights_ = &lights;
  this->Places_.assign(lights.Cells().size(), -1);
  for (std::size_t place = 0; place < this->Places_.size(); ++place)
  {
    const NearLights::Cell& near = lights.Cells()[place];
    const double depth =
      scale * scene.Smoke().Extinction(near.Index) * scene.Smoke().MeanChord(near.Index);
    double close = 0.0;
    bool clear = true;
    double closest = 0.0;
    Cut cut;
    const bool isPart = scene.Smoke().Parts().Find(near.Index) != nullptr;
    for (std::size_t i = 0; i < near.Lights.size() && depth > LeastShare && depth < MostDepth; ++i)
    {
      const NearLights::Light& own = near.Lights[i];
      if (own.Close)
      {
        const double mean = lights.Mean(place, i, light.Band());
        clear = clear && own.ClearBefore;
        close += mean;
        if (mean > closest)
        {
          closest = mean;
          cut = own.Clear && !isPart ? Cut() : this->CutOf(near.Index, own.Index);
        }
      }
    }
    const std::size_t index = field.CellIndex(light.Band(), near.Index);
    const double all = field.DirectFluence[index] + Mean(field.MultipleFluence[index]);
    if (clear && depth * close > LeastShare * all)
    {
      this->Places_[place] = static_cast<std::int32_t>(this->Cells_.size());
      Cell& own = this->Cells_.emplace_back();
      own.Index = near.Index;
      own.Plate = cut;
      own.Along = isPart ? PartPlaces : WholePlaces;
      if (cut.Axis >= 0)
      {
        const bool below = cut.Middle > 0.5;
        own.Sides = {!isPart || below, !isPart || !below};
      }
    }
  }
}

int NearMultiple::Place(std::int64_t cell) const
{
  const int near = this->Cells_.empty() ? -1 : this->Lights_->Place(cell);
  return near < 0 ? -1 : this->Places_[near];
}

NearMultiple::Cut NearMultiple::CutOf(std::int64_t cell, std::size_t light) const
{
  const Scene& scene = this->Light_.TheScene();
  const LightGroup& root = scene.Lights().Root(light);
  const Vec3 size = scene.Smoke().CellSize(cell);
  // The plane is where the shares from the cell's middle, times this, add up to the offset.
  const Vec3 normal = root.Normal * size;
  const double offset = glm::dot(root.Normal, root.Centre - scene.Smoke().CellCentre(cell));
  Cut cut;
  const Vec3 facing = glm::abs(normal);
  cut.Axis = facing.x > std::max(facing.y, facing.z) ? 0 : facing.y > facing.z ? 1 : 2;
  cut.Middle = 0.5 + offset / normal[cut.Axis];
  cut.Slopes = -normal / normal[cut.Axis];
  cut.Slopes[cut.Axis] = 0.0;
  bool cuts = false;
  for (int place = 0; place < 8; ++place)
  {
    const double below = cut.Below(ShareOf(place, 2));
    cuts = cuts || (below > LeastPart && below < 1.0 - LeastPart);
  }
  return cuts ? cut : Cut();
}

double NearMultiple::Value(std::int64_t cell, const Vec3& point) const
{
  Cell& own = this->Cells_[this->Place(cell)];
  tbb::collaborative_call_once(own.Found, [&] { this->Find(own); });
  const Medium& smoke = this->Light_.TheScene().Smoke();
  Vec3 share = 0.5 + (point - smoke.CellCentre(cell)) / smoke.CellSize(cell);
  int part = own.Sides[0] ? 0 : 1;
  if (own.Plate.Axis >= 0)
  {
    const double below = own.Plate.Below(share);
    double& along = share[own.Plate.Axis];
    if (own.Sides[0] && own.Sides[1])
    {
      // Of faces of the cell that the plane meets there is but one side.
      part = below <= 0.0 || (along > below && below < 1.0) ? 1 : 0;
    }
    const double length = part == 0 ? below : 1.0 - below;
    const double within = part == 0 ? along : along - below;
    along = within < length ? std::max(within / length, 0.0) : 1.0;
  }
  if (own.Along == PartPlaces)
  {
    // A part may reach beyond its box.
    share = glm::clamp(share, 0.0, 1.0);
  }
  const int along = own.Along;
  const std::array<double, 3> x = WeightsAt(share.x, along);
  const std::array<double, 3> y = WeightsAt(share.y, along);
  const std::array<double, 3> z = WeightsAt(share.z, along);
  double sum = 0.0;
  for (int place = 0; place < along * along * along; ++place)
  {
    sum += x[place % along] * y[place / along % along] * z[place / (along * along)] *
           own.Values[part][place];
  }
  return std::clamp(sum, 0.0, Largest);
}

Vec3 NearMultiple::PlaceIn(std::int64_t cell, const Vec3& place) const
{
  const Medium& smoke = this->Light_.TheScene().Smoke();
  const CellPart* const part = smoke.Parts().Find(cell);
  if (part == nullptr || smoke.Parts().Locate(part->Cell, place) == cell)
  {
    return place;
  }
  const Vec3 off = place - part->Centre;
  const auto next = std::min_element(part->Fine.begin(), part->Fine.end(),
    [&off](const PartSample& one, const PartSample& other)
    { return glm::distance(off, Vec3(one.Offset)) < glm::distance(off, Vec3(other.Offset)); });
  return part->Centre + Vec3(next->Offset);
}

void NearMultiple::Find(Cell& cell) const
{
  const Medium& smoke = this->Light_.TheScene().Smoke();
  const Vec3 centre = smoke.CellCentre(cell.Index);
  const Vec3 size = smoke.CellSize(cell.Index);
  const int axis = cell.Plate.Axis;
  const int count = cell.Along * cell.Along * cell.Along;
  std::array<std::array<Vec3, MostPlaces>, 2> places;
  std::array<std::array<double, MostPlaces>, 2> weights{};
  double all = 0.0;
  for (int place = 0; place < count; ++place)
  {
    const Vec3 share = ShareOf(place, cell.Along);
    const double below = cell.Plate.Below(share);
    for (int part = 0; part < 2; ++part)
    {
      Vec3 own = share;
      if (axis >= 0)
      {
        own[axis] = part == 0 ? share[axis] * below : below + share[axis] * (1.0 - below);
      }
      const Vec3 wanted = centre + (own - 0.5) * size;
      places[part][place] = this->PlaceIn(cell.Index, wanted);
      if (cell.Sides[part] && places[part][place] == wanted)
      {
        weights[part][place] = WeightOf(place, cell.Along) * (part == 0 ? below : 1.0 - below);
        all += weights[part][place];
      }
    }
  }
  std::array<std::array<double, MostPlaces>, 2> sums{};
  const EvenPoints points(DirectionsKey);
  for (int ray = 0; ray < Batches * RaysABatch; ++ray)
  {
    const auto random = points.Point(ray);
    const Vec3 direction = SphereDirection(random[0], random[1]);
    for (int part = 0; part < 2; ++part)
    {
      for (int place = 0; cell.Sides[part] && place < count; ++place)
      {
        sums[part][place] +=
          this->Light_.Radiance(places[part][place], direction, random[2], ray % Batches);
      }
    }
  }
  double mean = 0.0;
  for (int part = 0; part < 2; ++part)
  {
    mean +=
      std::inner_product(sums[part].begin(), sums[part].end(), weights[part].begin(), 0.0) / all;
  }
  for (int part = 0; part < 2; ++part)
  {
    for (int place = 0; place < count; ++place)
    {
      cell.Values[part][place] = mean > 0.0 ? sums[part][place] / mean : 1.0;
    }
  }
}

} // namespace smokevis
