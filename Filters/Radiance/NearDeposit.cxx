#include "NearDeposit.h"

#include "Sampler.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/gtc/constants.hpp>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Rays of all lights, the least and the most of a light, and the least of a leaf. 32768 of a sign
/// of 0.4 m know its fluence over a cell of 0.1 m to about half a percent, and all of it exactly;
/// up to sixteen lights have as many each, so that what they leave adds up.
constexpr double Rays = 524288.0;
constexpr double FewestOfLight = 4096.0;
constexpr double MostOfLight = 32768.0;
constexpr double FewestOfLeaf = 64.0;
/// Share of these rays that will do to know it to a percent.
constexpr double CoarseShare = 0.5;
/// Rays are followed in so many parts, whose sums are added in their order.
constexpr std::uint64_t Parts = 8;
constexpr std::uint64_t Key = 0x2ea7de9051;

double Brightest(const Spectrum& value)
{
  return *std::max_element(value.begin(), value.end());
}

} // namespace

struct NearDeposit::Ray
{
  Vec3 Origin, Direction;
  /// Shapes are sought from beside the origin, or the ray's own plate would be met.
  Vec3 Beside;
  /// [lm]
  Spectrum Power;
};

NearDeposit::NearDeposit(
  const Scene& scene, std::size_t light, std::vector<std::int64_t> cells, bool coarse)
    : Scene_(scene), Order_(cells.size()), Coarse_(coarse)
{
  std::iota(this->Order_.begin(), this->Order_.end(), std::size_t{0});
  std::sort(this->Order_.begin(), this->Order_.end(),
    [&cells](std::size_t a, std::size_t b) { return cells[a] < cells[b]; });
  const EmitterSet& lights = scene.Lights();
  const LightGroup& root = lights.Root(light);
  for (const std::size_t place : this->Order_)
  {
    const std::int64_t cell = cells[place];
    this->Cells_.push_back(cell);
    this->Reach_ =
      std::max(this->Reach_, glm::length(scene.Smoke().CellCentre(cell) - root.Centre) +
                               0.5 * glm::length(scene.Smoke().CellSize(cell)) + root.Radius);
  }
  this->FindLeaves(lights.Lights()[light]);
}

void NearDeposit::FindLeaves(int group)
{
  const LightGroup& node = this->Scene_.Lights().Groups()[group];
  if (node.FirstChild < 0)
  {
    this->Leaves_.push_back(group);
    return;
  }
  this->FindLeaves(node.FirstChild);
  this->FindLeaves(node.FirstChild + 1);
}

NearDeposit::Ray NearDeposit::Draw(std::size_t leaf, std::uint64_t index, std::uint64_t count) const
{
  const LightGroup& group = this->Scene_.Lights().Groups()[this->Leaves_[leaf]];
  const std::array<double, 4> point = EvenPoints(Mix(Key) + leaf).Point(index);
  const Vec3 aside = std::abs(group.Normal.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
  const Vec3 direction = LambertianDirection(
    group.Normal, glm::normalize(glm::cross(group.Normal, aside)), point[2], point[3]);
  const Vec3 origin = group.At(point[0], point[1]);
  Ray ray{origin, direction, origin + 10.0 * this->Scene_.Shapes().Tolerance() * group.Normal,
    Spectrum{}};
  const double weight = glm::pi<double>() * group.AreaAt(point[0], point[1]) / group.Area *
                        group.Law.Relative(direction, glm::dot(direction, group.Normal)) /
                        static_cast<double>(count);
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    ray.Power[band] = weight * group.Intensity[band];
  }
  return ray;
}

void NearDeposit::Follow(const Ray& ray, std::vector<Spectrum>& sums) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Hit hit = this->Scene_.Shapes().Intersect(ray.Beside, ray.Direction, 0.0, this->Reach_);
  thread_local std::vector<Segment> pieces;
  smoke.Walk(ray.Origin, ray.Direction, 0.0, std::min(this->Reach_, hit.Distance), pieces);
  Spectrum depth{};
  for (const Segment& piece : pieces)
  {
    const auto found = std::lower_bound(this->Cells_.begin(), this->Cells_.end(), piece.Cell);
    const bool wanted = found != this->Cells_.end() && *found == piece.Cell;
    const double length = piece.End - piece.Begin;
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      const double extinction = smoke.Extinction(piece.Cell) * this->Scene_.ExtinctionScale(band);
      const double own = extinction * length;
      if (wanted)
      {
        // Path length of what is left of the ray.
        const double path = own > 0.0 ? -std::expm1(-own) / extinction : length;
        sums[this->Order_[found - this->Cells_.begin()]][band] +=
          ray.Power[band] * std::exp(-depth[band]) * path;
      }
      depth[band] += own;
    }
  }
}

std::vector<Spectrum> NearDeposit::Run() const
{
  const std::vector<LightGroup>& groups = this->Scene_.Lights().Groups();
  const auto lights = static_cast<double>(this->Scene_.Lights().Lights().size());
  const double rays =
    (this->Coarse_ ? CoarseShare : 1.0) * std::clamp(Rays / lights, FewestOfLight, MostOfLight);
  double intensity = 0.0;
  for (const int leaf : this->Leaves_)
  {
    intensity += Brightest(groups[leaf].Intensity);
  }
  std::vector<std::vector<Spectrum>> parts(
    Parts, std::vector<Spectrum>(this->Cells_.size(), Spectrum{}));
  tbb::parallel_for(std::uint64_t{0}, Parts,
    [&](std::uint64_t part)
    {
      for (std::size_t leaf = 0; leaf < this->Leaves_.size(); ++leaf)
      {
        const double share = Brightest(groups[this->Leaves_[leaf]].Intensity) / intensity;
        const auto count = static_cast<std::uint64_t>(std::max(FewestOfLeaf, rays * share));
        for (std::uint64_t ray = part; ray < count; ray += Parts)
        {
          this->Follow(this->Draw(leaf, ray, count), parts[part]);
        }
      }
    });
  std::vector<Spectrum> means(this->Cells_.size(), Spectrum{});
  for (const std::vector<Spectrum>& part : parts)
  {
    for (std::size_t i = 0; i < means.size(); ++i)
    {
      for (int band = 0; band < this->Scene_.Bands(); ++band)
      {
        means[this->Order_[i]][band] +=
          part[this->Order_[i]][band] / this->Scene_.Smoke().OwnVolume(this->Cells_[i]);
      }
    }
  }
  return means;
}

} // namespace smokevis
