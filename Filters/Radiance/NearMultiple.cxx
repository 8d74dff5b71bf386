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

/// One of the two places along an axis, as a share of the cell: the mean over the places is that
/// over the cell of what varies up to the third power.
double ShareAlong(int corner, int axis)
{
  return Nodes2[corner >> axis & 1];
}

} // namespace

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
    for (std::size_t i = 0; i < near.Lights.size() && depth > LeastShare && depth < MostDepth; ++i)
    {
      if (near.Lights[i].Close)
      {
        clear = clear && near.Lights[i].Clear;
        close += lights.Mean(place, i, light.Band());
      }
    }
    const std::size_t index = field.CellIndex(light.Band(), near.Index);
    const double all = field.DirectFluence[index] + Mean(field.MultipleFluence[index]);
    if (clear && depth * close > LeastShare * all)
    {
      this->Places_[place] = static_cast<std::int32_t>(this->Cells_.size());
      this->Cells_.emplace_back().Index = near.Index;
    }
  }
}

int NearMultiple::Place(std::int64_t cell) const
{
  const int near = this->Cells_.empty() ? -1 : this->Lights_->Place(cell);
  return near < 0 ? -1 : this->Places_[near];
}

double NearMultiple::Value(std::int64_t cell, const Vec3& point) const
{
  Cell& own = this->Cells_[this->Place(cell)];
  tbb::collaborative_call_once(own.Found, [&] { this->Find(own); });
  const Medium& smoke = this->Light_.TheScene().Smoke();
  const Vec3 share = 0.5 + (point - smoke.CellCentre(cell)) / smoke.CellSize(cell);
  const Vec3 upper = (share - Nodes2[0]) / (Nodes2[1] - Nodes2[0]);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= (corner >> axis & 1) != 0 ? upper[axis] : 1.0 - upper[axis];
    }
    sum += weight * own.Values[corner];
  }
  return std::max(0.0, sum);
}

void NearMultiple::Find(Cell& cell) const
{
  const Box box = this->Light_.TheScene().Smoke().BoxOf(cell.Index);
  std::array<Vec3, 8> places;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 share(ShareAlong(corner, 0), ShareAlong(corner, 1), ShareAlong(corner, 2));
    places[corner] = box.Lower + share * box.Size();
  }
  std::array<double, 8> sums{};
  const EvenPoints points(DirectionsKey);
  for (int ray = 0; ray < Batches * RaysABatch; ++ray)
  {
    const auto random = points.Point(ray);
    const Vec3 direction = SphereDirection(random[0], random[1]);
    for (int corner = 0; corner < 8; ++corner)
    {
      sums[corner] += this->Light_.Radiance(places[corner], direction, random[2], ray % Batches);
    }
  }
  const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / 8.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    cell.Values[corner] = mean > 0.0 ? sums[corner] / mean : 1.0;
  }
}

} // namespace smokevis
