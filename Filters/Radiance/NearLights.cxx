#include "NearLights.h"

#include "NearDeposit.h"
#include "OpenFaces.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// A light counts as near to a cell within so many cell edges of the cell. Not a whole number, so
/// that no distance of a regular scene is at the limit, where rounding would decide.
constexpr double NearEdges = 4.01;
/// Closer than this, a cell's mean is not found from a few points.
constexpr double CloseEdges = 2.01;
/// Sharpest law of emission of lights whose fluence is kept on lattices.
constexpr double SmoothestLaw = 1.4;

/// Cells that a plate lies in or touches have their centres within so many edges of it; above this
/// optical depth it is the light itself that tells what it leaves there.
constexpr double TouchEdges = 0.9;
constexpr double DepositDepth = 0.019;
/// Where the smoke around a light is so uneven, that holds for all cells near to it: a few places
/// in each miss what comes in through gaps between thick ones.
constexpr double DepositUnevenness = 0.15;
/// The same, of so many lights at most: more would take long, or too few rays of each.
constexpr std::size_t MostDeposits = 32;

/// Longest steps of lattices in edges of the largest cells: this over the smoke's unevenness, or
/// the finest. Where that is 0.1, steps of an edge leave 8 % of the light unknown, a quarter of one
/// 1 %.
constexpr double StepOverUnevenness = 0.02;
constexpr double FinestStep = 0.25;

/// What coarse ones ask of direct light: as little as any tolerance does.
constexpr double CoarseTolerance = 0.1;

} // namespace

NearLights::NearLights(const Scene& scene, bool coarse)
    : Scene_(scene), Coarse_(coarse), Direct_(scene, nullptr, coarse ? CoarseTolerance : 0.0),
      Fields_(scene.Lights().Lights().size()), DepositsIn_(Fields_.size()),
      Deposited_(Fields_.size()), Bands_(scene.Bands())
{
  const Medium& smoke = scene.Smoke();
  const EmitterSet& lights = scene.Lights();
  if (smoke.Empty())
  {
    return;
  }
  this->Places_.assign(smoke.Cells(), -1);
  std::vector<bool> uneven(this->Fields_.size());
  for (std::size_t light = 0; light < this->Fields_.size(); ++light)
  {
    const Surroundings around = this->FindCells(light);
    // Light that changes quickly with the angle would need finer lattices.
    const LightGroup& root = lights.Root(light);
    if (around.Reach > 0.0 && !root.Law.Measured() && root.Law.Sharpness() <= SmoothestLaw)
    {
      uneven[light] = around.Unevenness > DepositUnevenness && uneven.size() <= MostDeposits;
      const double edge = around.Reach / NearEdges;
      this->Fields_[light] = std::make_unique<NearField>(scene, this->Direct_, light, around.Reach,
        edge * std::max(FinestStep, StepOverUnevenness / around.Unevenness), coarse);
    }
  }
  tbb::parallel_for(std::size_t{0}, this->Cells_.size(),
    [&](std::size_t i)
    {
      Cell& cell = this->Cells_[i];
      const double edge = LargestEdge(smoke.CellSize(cell.Index));
      for (Light& light : cell.Lights)
      {
        light.Clear = this->Direct_.Clear(light.Index, cell.Index);
        light.ClearBefore = light.Clear || this->Direct_.ClearBefore(light.Index, cell.Index);
        const LightGroup& root = lights.Root(light.Index);
        const double distance = root.Distance(smoke.CellCentre(cell.Index));
        light.Close = distance < CloseEdges * edge;
        light.Deposits =
          (distance < TouchEdges * edge || uneven[light.Index]) &&
          smoke.Extinction(cell.Index) * scene.LargestScale() * edge > DepositDepth &&
          smoke.OwnVolume(cell.Index) > 0.0;
        cell.Close = cell.Close || light.Close;
      }
    });
  std::size_t pairs = 0;
  for (const Cell& cell : this->Cells_)
  {
    this->FirstMean_.push_back(pairs);
    pairs += cell.Lights.size();
  }
  this->Means_ = std::vector<std::atomic<float>>(pairs * this->Bands_);
  for (std::atomic<float>& mean : this->Means_)
  {
    mean.store(std::numeric_limits<float>::quiet_NaN(), std::memory_order_relaxed);
  }
  for (std::size_t cell = 0; cell < this->Cells_.size(); ++cell)
  {
    for (const Light& light : this->Cells_[cell].Lights)
    {
      if (light.Deposits)
      {
        this->DepositsIn_[light.Index].push_back(cell);
      }
    }
  }
}

int NearLights::Find(std::size_t cell, std::size_t light) const
{
  const std::vector<Light>& there = this->Cells_[cell].Lights;
  const auto found = std::find_if(
    there.begin(), there.end(), [light](const Light& near) { return near.Index == light; });
  return found == there.end() ? -1 : static_cast<int>(found - there.begin());
}

void NearLights::Deposit(std::size_t light) const
{
  tbb::collaborative_call_once(this->Deposited_[light],
    [&]
    {
      const std::vector<std::size_t>& places = this->DepositsIn_[light];
      if (places.empty())
      {
        return;
      }
      std::vector<std::int64_t> cells;
      for (const std::size_t place : places)
      {
        cells.push_back(this->Cells_[place].Index);
      }
      const std::vector<Spectrum> means =
        NearDeposit(this->Scene_, light, cells, this->Coarse_).Run();
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        this->Keep(this->MeanIndex(places[i], this->Find(places[i], light)), means[i]);
      }
    });
}

void NearLights::Keep(std::size_t index, const Spectrum& mean) const
{
  for (std::size_t band = 0; band < this->Bands_; ++band)
  {
    this->Means_[index + band].store(static_cast<float>(mean[band]), std::memory_order_relaxed);
  }
}

double NearLights::FindMean(std::size_t cell, std::size_t light, int band) const
{
  const Light& near = this->Cells_[cell].Lights[light];
  if (near.Deposits)
  {
    this->Deposit(near.Index);
    return this->Means_[this->MeanIndex(cell, light) + band].load(std::memory_order_relaxed);
  }
  const Spectrum mean = this->Direct_.NearCellFluence(
    near.Index, this->Cells_[cell].Index, near.Clear, this->Fields_[near.Index].get());
  this->Keep(this->MeanIndex(cell, light), mean);
  return static_cast<float>(mean[band]);
}

NearLights::Surroundings NearLights::FindCells(std::size_t light)
{
  const Medium& smoke = this->Scene_.Smoke();
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const double largest = NearEdges * smoke.LargestEdge();
  const Vec3 low = glm::min(glm::min(root.Corners[0], root.Corners[1]),
                     glm::min(root.Corners[2], root.Corners[3])) -
                   largest;
  const Vec3 high = glm::max(glm::max(root.Corners[0], root.Corners[1]),
                      glm::max(root.Corners[2], root.Corners[3])) +
                    largest;
  Surroundings around;
  double squares = 0.0;
  int count = 0;
  smoke.ForCellsIn(low, high,
    [&](std::int64_t cell)
    {
      if (smoke.Extinction(cell) == 0.0F)
      {
        return;
      }
      const Vec3 centre = smoke.CellCentre(cell);
      const Vec3 size = smoke.CellSize(cell);
      const double distance = root.Distance(centre);
      // Behind a plate there is none of its light.
      if (distance >= NearEdges * LargestEdge(size) ||
          glm::dot(centre - root.Centre, root.Normal) <= -root.Radius - glm::length(size))
      {
        return;
      }
      std::int32_t& place = this->Places_[cell];
      if (place < 0)
      {
        place = static_cast<std::int32_t>(this->Cells_.size());
        this->Cells_.push_back({cell, {}, false});
      }
      this->Cells_[place].Lights.push_back(Light{.Index = static_cast<std::uint32_t>(light)});
      around.Reach = std::max(around.Reach, distance + 0.5 * glm::length(size));
      for (int axis = 0; axis < 3; ++axis)
      {
        const std::int64_t below = this->Scene_.Open().Neighbour(cell, axis, 0);
        const std::int64_t above = this->Scene_.Open().Neighbour(cell, axis, 1);
        if (below >= 0 && above >= 0)
        {
          const double beside = 0.5 * (smoke.Extinction(below) + smoke.Extinction(above));
          const double off = (smoke.Extinction(cell) - beside) * size[axis];
          squares += off * off;
          ++count;
        }
      }
    });
  around.Unevenness =
    this->Scene_.LargestScale() * std::sqrt(squares / static_cast<double>(std::max(1, count)));
  return around;
}

} // namespace smokevis
