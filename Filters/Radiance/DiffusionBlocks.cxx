#include "DiffusionBlocks.h"

#include "OpenFaces.h"
#include "OutsideRegions.h"
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
/// Share of the light in a region outside of all smoke that leaves the scene, above which none of
/// it is taken to come back.
constexpr double MostEscapes = 0.98;
/// Areas that differ by less are those of cells of one size.
constexpr double SameSize = 1e-6;
/// Relative residual to which the equation is solved: deep in smoke light is a billionth of what it
/// is where it comes in, and it would take hundreds of sweeps to mend it there. Where hardly any
/// light is lost that may not be reached; to the larger one sweeps mend the rest.
constexpr double SolverTolerance = 1e-10;
constexpr double LargestResidual = 1e-3;
constexpr int MostIterations = 2000;
/// Share of what blocks that pass light to each other take up and pass on that is lost where any
/// is.
constexpr double SealedShare = 1e-10;

} // namespace

/// Sums over the cells of a block, and over what bounds it.
struct DiffusionBlocks::Sums
{
  /// Of the box that it lies in, at least that of its largest cell [m].
  Vec3 Size = Vec3(0.0);
  double Volume = 0.0, Capture = 0.0;
  Vec3 Moment = Vec3(0.0);

  double Extinction() const { return this->Capture / this->Volume; }
  Vec3 Centre() const { return this->Moment / this->Volume; }
  /// From its middle to where it ends in some direction.
  double DepthTo(const Vec3& direction) const
  {
    return 0.5 * this->Extinction() * glm::dot(direction, this->Size);
  }
};

/// What lies outside of all smoke: blocks of clear air.
struct DiffusionBlocks::Outside
{
  OutsideRegions Regions;
  /// Block of each region, after those of the smoke; -1 where hardly any light comes back.
  std::vector<std::int32_t> Blocks;
  /// First of them, and one behind the last.
  std::int32_t First, End;

  Outside(const Scene& scene, std::int32_t first) : Regions(scene), First(first), End(first)
  {
    for (std::size_t region = 0; region < this->Regions.Count(); ++region)
    {
      const bool open = this->Regions.EscapingShare(region) > MostEscapes;
      this->Blocks.push_back(open ? -1 : this->End++);
    }
  }
  std::int32_t OfSide(std::size_t side) const
  {
    const std::int32_t region = this->Regions.OfSide(side);
    return region < 0 ? -1 : this->Blocks[region];
  }
};

DiffusionBlocks::DiffusionBlocks(const Scene& scene, int band, const std::vector<float>& extinction)
    : Block_(extinction.size(), -1), Scattering_(extinction.size(), 0.0F)
{
  const std::vector<Sums> blocks = this->FormBlocks(scene, extinction);
  const Outside outside(scene, static_cast<std::int32_t>(blocks.size()));
  this->FindSides(scene, band, blocks, outside);
  this->FormOperator(scene.Albedo(), blocks, this->FindFaces(scene), outside);
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

DiffusionBlocks::Areas DiffusionBlocks::FindFaces(const Scene& scene) const
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
      if (to >= 0 && to != from)
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

void DiffusionBlocks::FindSides(
  const Scene& scene, int band, const std::vector<Sums>& blocks, const Outside& outside)
{
  const Medium& smoke = scene.Smoke();
  const auto block = [&](std::size_t side, const Vec3& point)
  {
    const std::int64_t cell = smoke.Locate(point);
    return cell < 0 ? outside.OfSide(side) : this->Block_[cell];
  };
  const auto depth = [&](std::int32_t beside, const Vec3& normal)
  { return beside >= outside.First ? 0.0 : blocks[beside].DepthTo(glm::abs(normal)); };
  const Vec3 size = blocks.front().Size;
  this->Sides_.emplace(scene, band, block, depth, static_cast<std::size_t>(outside.End),
    std::min({size.x, size.y, size.z}));
}

void DiffusionBlocks::FormOperator(
  double albedo, const std::vector<Sums>& blocks, const Areas& between, const Outside& outside)
{
  const auto count = static_cast<std::size_t>(outside.End);
  std::vector<Eigen::Triplet<double>> entries;
  boost::disjoint_sets_with_storage<> joined(count);
  std::vector<double> passed(count, 0.0);
  const auto pass = [&](std::int32_t one, std::int32_t other, double passes)
  {
    joined.union_set(one, other);
    passed[one] += passes;
    passed[other] += passes;
    entries.emplace_back(one, one, passes);
    entries.emplace_back(one, other, -passes);
    entries.emplace_back(other, other, passes);
    entries.emplace_back(other, one, -passes);
  };
  for (const auto& [pair, area] : between)
  {
    const auto [one, other] = pair;
    const double depth = 0.5 * (blocks[one].Extinction() + blocks[other].Extinction()) *
                         glm::distance(blocks[one].Centre(), blocks[other].Centre());
    pass(one, other, area / DiffusionResistance(depth, 0.0));
  }
  this->Escape_.assign(count, 0.0);
  const auto& faces = outside.Regions.Faces();
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const std::int32_t from = this->Block_[faces[i].Cell];
    const std::int32_t to = outside.Blocks[outside.Regions.OfFace(i)];
    Vec3 direction(0.0);
    direction[faces[i].Axis] = 1.0;
    const double leaves = faces[i].Area * IncidentShare(0.0, blocks[from].DepthTo(direction));
    if (to < 0)
    {
      this->Escape_[from] += leaves;
    }
    else
    {
      pass(from, to, leaves);
    }
  }
  for (const auto& [pair, area] : outside.Regions.Passages())
  {
    const std::int32_t one = outside.Blocks[pair.first];
    const std::int32_t other = outside.Blocks[pair.second];
    // Even light passes a quarter of its fluence.
    if (one >= 0 && other >= 0)
    {
      pass(one, other, 0.25 * area);
    }
    else if (std::max(one, other) >= 0)
    {
      this->Escape_[std::max(one, other)] += 0.25 * area;
    }
  }
  for (std::size_t region = 0; region < outside.Blocks.size(); ++region)
  {
    if (outside.Blocks[region] >= 0)
    {
      // Even light brings a quarter of its fluence to what bounds it, and to ways out of the scene:
      // these are to the rest as what escapes is to what does not.
      const double share = outside.Regions.EscapingShare(region);
      this->Escape_[outside.Blocks[region]] +=
        0.25 * outside.Regions.BoundingArea(region) * share / (1.0 - share);
    }
  }
  std::vector<double> losses;
  for (std::int32_t i = 0; i < outside.End; ++i)
  {
    // What absorbs more than even light brings to all around a block belongs to others, too.
    const double absorbed = this->Sides_->Absorbed(i);
    const bool inSmoke = i < outside.First;
    const double most = inSmoke ? std::min(absorbed, 0.25 * BoxSurface(blocks[i].Size)) : absorbed;
    const double capture = inSmoke ? blocks[i].Capture : 0.0;
    const double lost = (1.0 - albedo) * capture + this->Escape_[i] + most;
    losses.push_back(lost);
    this->Loss_ += lost;
    this->Capture_.push_back(capture);
    this->Escape_[i] += most - absorbed;
  }
  // What lies within white walls may keep all of its light for itself.
  std::vector<double> lostTogether(count, 0.0);
  std::vector<double> heldTogether(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    lostTogether[joined.find_set(i)] += losses[i];
    heldTogether[joined.find_set(i)] += passed[i] + this->Capture_[i];
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t together = joined.find_set(i);
    this->Sealed_.push_back(lostTogether[together] <= SealedShare * heldTogether[together]);
    const auto place = static_cast<std::int32_t>(i);
    entries.emplace_back(place, place, this->Sealed_[i] ? 1.0 : losses[i]);
  }
  this->Operator_.resize(outside.End, outside.End);
  this->Operator_.setFromTriplets(entries.begin(), entries.end());
}

void DiffusionBlocks::CompleteSums(double step, BatchState& batch) const
{
  for (std::size_t block = 0; block < this->Count(); ++block)
  {
    batch.Residual[block] = this->Sealed_[block] ? 0.0 : batch.Residual[block];
  }
  const Eigen::Map<const Eigen::VectorXd> residual(
    batch.Residual.data(), static_cast<Eigen::Index>(this->Count()));
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(SolverTolerance);
  solver.setMaxIterations(MostIterations);
  solver.compute(this->Operator_);
  const Eigen::VectorXd lacks = step * solver.solve(residual);
  // Where it is not solved, sweeps build the light up by themselves.
  if (solver.error() <= LargestResidual)
  {
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
      const double own = step * this->Sides_->Own(side) * batch.Residual[this->Count() + side];
      batch.Lacking[this->Count() + side] += own;
      batch.IlluminanceSum[side] +=
        static_cast<float>(this->Sides_->Illuminance(side, lacks) + own);
    }
  }
  std::fill(batch.Residual.begin(), batch.Residual.end(), 0.0);
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
  for (std::size_t side = 0; side < this->Sides_->Count(); ++side)
  {
    double sum = 0.0;
    for (const BatchState& batch : batches)
    {
      sum += batch.Lacking[this->Count() + side];
    }
    lack.Illuminance.push_back(sum / (sweeps * count));
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
        batch.Illuminance[side] += static_cast<float>(
          this->Sides_->Illuminance(side, lack.Fluence) + lack.Illuminance[side]);
      }
      std::fill(batch.Lacking.begin(), batch.Lacking.end(), 0.0);
    });
}

} // namespace smokevis
