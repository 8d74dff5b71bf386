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

/// One of the eight places, as shares of the cell along each axis: the mean over the places is that
/// over the cell of what varies up to the third power.
Vec3 ShareOf(int corner)
{
  return {Nodes2[corner & 1], Nodes2[corner >> 1 & 1], Nodes2[corner >> 2 & 1]};
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
          cut = own.Clear ? Cut() : this->CutOf(near.Index, own.Index);
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
  cut.Axis = std::abs(normal.x) > std::max(std::abs(normal.y), std::abs(normal.z)) ? 0
             : std::abs(normal.y) > std::abs(normal.z)                             ? 1
                                                                                   : 2;
  cut.Middle = 0.5 + offset / normal[cut.Axis];
  cut.Slopes = -normal / normal[cut.Axis];
  cut.Slopes[cut.Axis] = 0.0;
  bool cuts = false;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double below = cut.Below(ShareOf(corner));
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
  int part = 0;
  if (own.Plate.Axis >= 0)
  {
    const double below = own.Plate.Below(share);
    double& along = share[own.Plate.Axis];
    // Of faces of the cell that the plane meets there is but one side.
    part = below <= 0.0 || (along > below && below < 1.0) ? 1 : 0;
    along = part == 1 ? (along - below) / (1.0 - below) : along / below;
  }
  const Vec3 upper = (share - Nodes2[0]) / (Nodes2[1] - Nodes2[0]);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= (corner >> axis & 1) != 0 ? upper[axis] : 1.0 - upper[axis];
    }
    sum += weight * own.Values[part][corner];
  }
  return std::clamp(sum, 0.0, Largest);
}

void NearMultiple::Find(Cell& cell) const
{
  const Box box = this->Light_.TheScene().Smoke().BoxOf(cell.Index);
  const int axis = cell.Plate.Axis;
  std::array<std::array<Vec3, 8>, 2> places;
  std::array<std::array<double, 8>, 2> weights{};
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 share = ShareOf(corner);
    const double below = cell.Plate.Below(share);
    weights[0][corner] = below;
    weights[1][corner] = 1.0 - below;
    for (int part = 0; part < 2; ++part)
    {
      Vec3 own = share;
      if (axis >= 0)
      {
        own[axis] = part == 0 ? share[axis] * below : below + share[axis] * (1.0 - below);
      }
      places[part][corner] = box.Lower + own * box.Size();
    }
  }
  std::array<std::array<double, 8>, 2> sums{};
  const EvenPoints points(DirectionsKey);
  for (int ray = 0; ray < Batches * RaysABatch; ++ray)
  {
    const auto random = points.Point(ray);
    const Vec3 direction = SphereDirection(random[0], random[1]);
    for (int part = 0; part < (axis >= 0 ? 2 : 1); ++part)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        sums[part][corner] +=
          this->Light_.Radiance(places[part][corner], direction, random[2], ray % Batches);
      }
    }
  }
  double mean = 0.0;
  for (int part = 0; part < 2; ++part)
  {
    mean +=
      std::inner_product(sums[part].begin(), sums[part].end(), weights[part].begin(), 0.0) / 8.0;
  }
  for (int part = 0; part < 2; ++part)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      cell.Values[part][corner] = mean > 0.0 ? sums[part][corner] / mean : 1.0;
    }
  }
}

} // namespace smokevis
