#include "DiffusionBlocks.h"

#include "OpenFaces.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/IterativeLinearSolvers>
#include <boost/pending/disjoint_sets.hpp>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Optical depth of a block, and how many there are along an axis, at most.
constexpr double BlockDepth = 1.0;
constexpr double MostAlongAxis = 32.0;
/// Cells whose middle lies right between blocks, and smoke a whole number of blocks deep: rounding
/// must not decide.
constexpr double Aside = 1e-6;
/// Share of even light that may come back from outside of all blocks; a tenth by rounding, too.
constexpr double MostFromOutside = 0.1 * (1.0 + 1e-6);
/// Areas that differ by less are those of cells of one size.
constexpr double SameSize = 1e-6;
/// Relative residual to which the equation is solved: sweeps mend the rest. Some two hundred
/// iterations do.
constexpr double SolverTolerance = 1e-3;
constexpr int MostIterations = 2000;

/// Whether a face is the end of the smoke, and no surface stands between it and the cell's middle.
bool EndsOpen(const Scene& scene, std::int64_t cell, int axis, int side)
{
  if (scene.Smoke().Neighbour(cell, axis, side) >= 0)
  {
    return false;
  }
  Vec3 direction(0.0);
  direction[axis] = side == 0 ? -1.0 : 1.0;
  const double gap = 10.0 * scene.Shapes().Tolerance();
  return !scene.Shapes().Occluded(
    scene.Smoke().CellCentre(cell), direction, 0.0, 0.5 * scene.Smoke().CellSize(cell)[axis] + gap);
}

double FaceArea(const Vec3& size, int axis)
{
  return size[(axis + 1) % 3] * size[(axis + 2) % 3];
}

} // namespace

/// Sums over the cells of a block, and over what bounds it.
struct DiffusionBlocks::Sums
{
  /// Of the box that it lies in, at least that of its largest cell [m].
  Vec3 Size = Vec3(0.0);
  double Volume = 0.0, Capture = 0.0;
  Vec3 Moment = Vec3(0.0);
  /// Area across each axis where the smoke ends and no surface is [m2].
  Vec3 Open = Vec3(0.0);

  double Extinction() const { return this->Capture / this->Volume; }
  Vec3 Centre() const { return this->Moment / this->Volume; }
};

DiffusionBlocks::DiffusionBlocks(const Scene& scene, int band, const std::vector<float>& extinction)
    : Block_(extinction.size(), -1), Scattering_(extinction.size(), 0.0F)
{
  std::vector<Sums> blocks = this->FormBlocks(scene, extinction);
  const Areas between = this->FindFaces(scene, blocks);
  this->FindSides(scene, band, blocks);
  this->FormOperator(scene.Albedo(), blocks, between);
}

std::vector<DiffusionBlocks::Sums> DiffusionBlocks::FormBlocks(
  const Scene& scene, const std::vector<float>& extinction)
{
  const Medium& smoke = scene.Smoke();
  const auto ownVolume = [&](std::size_t cell)
  { return smoke.OwnVolume(static_cast<std::int64_t>(cell)); };
  // Where the smoke is dense, light is scattered most.
  double capture = 0.0;
  double squares = 0.0;
  for (std::size_t cell = 0; cell < extinction.size(); ++cell)
  {
    const double own = extinction[cell] * ownVolume(cell);
    capture += own;
    squares += extinction[cell] * own;
  }
  const Vec3 extent = glm::max(smoke.Upper() - smoke.Lower(), Vec3(1e-300));
  const Vec3 counts =
    glm::clamp(glm::ceil(extent * (squares / std::max(capture, 1e-300) / BlockDepth) - Aside), 1.0,
      MostAlongAxis);
  const Vec3 blockSize = extent / counts;

  // Boxes of cells; walls part them into blocks that light passes through.
  std::vector<std::int64_t> box(extinction.size(), -1);
  for (std::size_t i = 0; i < extinction.size(); ++i)
  {
    if (ownVolume(i) > 0.0)
    {
      const Vec3 place = glm::clamp(
        glm::floor(
          (smoke.CellCentre(static_cast<std::int64_t>(i)) - smoke.Lower()) / blockSize + Aside),
        Vec3(0.0), counts - 1.0);
      box[i] = static_cast<std::int64_t>(place.x + counts.x * (place.y + counts.y * place.z));
    }
  }
  boost::disjoint_sets_with_storage<> joined(extinction.size());
  for (std::size_t i = 0; i < extinction.size(); ++i)
  {
    for (int face = 0; face < 6 && box[i] >= 0; ++face)
    {
      const std::int64_t other =
        scene.Open().Neighbour(static_cast<std::int64_t>(i), face / 2, face % 2);
      if (other >= 0 && box[other] == box[i])
      {
        joined.union_set(i, static_cast<std::size_t>(other));
      }
    }
  }
  std::vector<Sums> blocks;
  std::vector<std::int32_t> numbers(extinction.size(), -1);
  for (std::size_t i = 0; i < extinction.size(); ++i)
  {
    if (box[i] < 0)
    {
      continue;
    }
    std::int32_t& number = numbers[joined.find_set(i)];
    if (number < 0)
    {
      number = static_cast<std::int32_t>(blocks.size());
      blocks.emplace_back().Size = blockSize;
    }
    const double own = ownVolume(i);
    this->Block_[i] = number;
    this->Scattering_[i] = static_cast<float>(scene.Albedo() * extinction[i] * own);
    Sums& block = blocks[number];
    block.Size = glm::max(block.Size, smoke.CellSize(static_cast<std::int64_t>(i)));
    block.Volume += own;
    block.Capture += extinction[i] * own;
    block.Moment += own * (smoke.CellCentre(static_cast<std::int64_t>(i)) - smoke.Lower());
  }
  return blocks;
}

DiffusionBlocks::Areas DiffusionBlocks::FindFaces(
  const Scene& scene, std::vector<Sums>& blocks) const
{
  const Medium& smoke = scene.Smoke();
  Areas between;
  for (std::size_t i = 0; i < this->Block_.size(); ++i)
  {
    const std::int32_t from = this->Block_[i];
    const auto cell = static_cast<std::int64_t>(i);
    if (from < 0)
    {
      continue;
    }
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2;
      const int side = face % 2;
      const double area = FaceArea(smoke.CellSize(cell), axis);
      const std::int64_t other = scene.Open().Neighbour(cell, axis, side);
      const double otherArea = other < 0 ? area : FaceArea(smoke.CellSize(other), axis);
      if (area > (1.0 + SameSize) * otherArea)
      {
        // Its many small neighbours have the face between them.
        continue;
      }
      const std::int32_t to = other < 0 ? -1 : this->Block_[other];
      if (to < 0)
      {
        blocks[from].Open[axis] += EndsOpen(scene, cell, axis, side) ? area : 0.0;
      }
      else if (to != from)
      {
        // Faces between cells of one size come twice, but for those where a finer grid begins.
        const bool twice = otherArea <= (1.0 + SameSize) * area &&
                           scene.Open().Neighbour(other, axis, 1 - side) == cell;
        between[std::minmax(from, to)] += twice ? 0.5 * area : area;
      }
    }
  }
  return between;
}

void DiffusionBlocks::FindSides(const Scene& scene, int band, const std::vector<Sums>& blocks)
{
  const Medium& smoke = scene.Smoke();
  const auto block = [&](const Vec3& point)
  {
    const std::int64_t cell = smoke.Locate(point);
    return cell < 0 ? -1 : this->Block_[cell];
  };
  const auto depth = [&](std::int32_t beside, const Vec3& normal)
  {
    const Sums& own = blocks[beside];
    return 0.5 * own.Extinction() * glm::dot(glm::abs(normal), own.Size);
  };
  const Vec3 size = blocks.front().Size;
  this->Sides_.emplace(
    scene, band, block, depth, blocks.size(), std::min({size.x, size.y, size.z}));
}

void DiffusionBlocks::FormOperator(
  double albedo, const std::vector<Sums>& blocks, const Areas& between)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [pair, area] : between)
  {
    const auto [one, other] = pair;
    const double depth = 0.5 * (blocks[one].Extinction() + blocks[other].Extinction()) *
                         glm::distance(blocks[one].Centre(), blocks[other].Centre());
    const double passes = area / DiffusionResistance(depth, 0.0);
    entries.emplace_back(one, one, passes);
    entries.emplace_back(one, other, -passes);
    entries.emplace_back(other, other, passes);
    entries.emplace_back(other, one, -passes);
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    const Sums& block = blocks[i];
    double leaves = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Open_ += block.Open[axis];
      leaves += block.Open[axis] * IncidentShare(0.0, 0.5 * block.Extinction() * block.Size[axis]);
    }
    // Even light brings a quarter of its fluence to a surface: what absorbs more than all around
    // the block belongs to others, too.
    const double absorbed = this->Sides_->Absorbed(i);
    const double lost = leaves + std::min(absorbed, 0.25 * BoxSurface(block.Size));
    const auto index = static_cast<Eigen::Index>(i);
    entries.emplace_back(index, index, (1.0 - albedo) * block.Capture + lost);
    this->Loss_ += (1.0 - albedo) * block.Capture + lost;
    this->Capture_.push_back(block.Capture);
    this->Escape_.push_back(lost - absorbed);
  }
  const auto count = static_cast<Eigen::Index>(blocks.size());
  this->Operator_.resize(count, count);
  this->Operator_.setFromTriplets(entries.begin(), entries.end());
}

bool DiffusionBlocks::Serve(const Scene& scene, int band) const
{
  double bounding = 0.0;
  double outside = 0.0;
  double reflects = 0.0;
  for (std::size_t side = 0; side < this->Sides_->Count(); ++side)
  {
    const double exposed = scene.ExposedArea(side / 2, static_cast<int>(side % 2));
    const bool bounds = this->Sides_->Bounds(side);
    bounding += bounds ? exposed : 0.0;
    outside += bounds ? 0.0 : exposed;
    reflects += bounds ? 0.0 : exposed * scene.PatchReflectance(side / 2)[band];
  }
  // No more comes back than leaves.
  const double back = outside > 0.0 ? reflects / outside * std::min(outside, this->Open_) : 0.0;
  return this->Loss_ > 0.0 && back <= MostFromOutside * (bounding + this->Open_);
}

void DiffusionBlocks::CompleteSums(double step, BatchState& batch) const
{
  Eigen::Map<Eigen::VectorXd> residual(
    batch.Residual.data(), static_cast<Eigen::Index>(batch.Residual.size()));
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(SolverTolerance);
  solver.setMaxIterations(MostIterations);
  solver.compute(this->Operator_);
  const Eigen::VectorXd lacks = step * solver.solve(residual);
  residual.setZero();
  if (solver.info() != Eigen::Success)
  {
    // Sweeps then build the light up by themselves.
    return;
  }
  for (Eigen::Index block = 0; block < lacks.size(); ++block)
  {
    batch.Lacking[block] += lacks[block];
    batch.EscapedSum += this->Escape_[block] * lacks[block];
  }
  for (std::size_t cell = 0; cell < this->Block_.size(); ++cell)
  {
    batch.FluenceSum[cell] +=
      this->Block_[cell] < 0 ? 0.0F : static_cast<float>(lacks[this->Block_[cell]]);
  }
  for (std::size_t side = 0; side < this->Sides_->Count(); ++side)
  {
    batch.IlluminanceSum[side] += static_cast<float>(this->Sides_->Illuminance(side, lacks));
  }
}

DiffusionBlocks::Lack DiffusionBlocks::LackOf(
  int sweeps, const std::vector<BatchState>& batches) const
{
  const auto count = static_cast<double>(batches.size());
  Lack lack;
  double size = 0.0;
  double error = 0.0;
  for (std::size_t block = 0; block < this->Count(); ++block)
  {
    double sum = 0.0;
    double squares = 0.0;
    for (const BatchState& batch : batches)
    {
      const double own = batch.Lacking[block] / sweeps;
      sum += own;
      squares += own * own;
    }
    const double mean = sum / count;
    lack.Fluence.push_back(mean);
    size += this->Capture_[block] * mean * mean;
    error += this->Capture_[block] * (squares / count - mean * mean) / (count - 1.0);
  }
  std::vector<double> mets(batches.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, batches.size(),
    [&](std::size_t i)
    {
      for (std::size_t cell = 0; cell < this->Block_.size(); ++cell)
      {
        mets[i] += this->Scattering_[cell] * batches[i].FluenceSum[cell];
      }
    });
  const double met =
    std::accumulate(mets.begin(), mets.end(), 0.0) / (count * std::max(1, batches.front().Counted));
  const double capture = std::accumulate(this->Capture_.begin(), this->Capture_.end(), 0.0);
  const double scattering =
    std::accumulate(this->Scattering_.begin(), this->Scattering_.end(), 0.0);
  const double fluence = scattering > 0.0 ? std::abs(met) / scattering : 0.0;
  if (fluence > 0.0)
  {
    lack.Size = std::sqrt(size / capture) / fluence;
    lack.Error = std::sqrt(std::max(0.0, error) / capture) / fluence;
  }
  return lack;
}

void DiffusionBlocks::Complete(const Lack& lack, std::vector<BatchState>& batches) const
{
  tbb::parallel_for(std::size_t{0}, batches.size(),
    [&](std::size_t i)
    {
      BatchState& batch = batches[i];
      for (std::size_t cell = 0; cell < this->Block_.size(); ++cell)
      {
        batch.Fluence[cell] +=
          this->Block_[cell] < 0 ? 0.0F : static_cast<float>(lack.Fluence[this->Block_[cell]]);
      }
      for (std::size_t side = 0; side < this->Sides_->Count(); ++side)
      {
        batch.Illuminance[side] +=
          static_cast<float>(this->Sides_->Illuminance(side, lack.Fluence));
      }
      std::fill(batch.Lacking.begin(), batch.Lacking.end(), 0.0);
    });
}

} // namespace smokevis
