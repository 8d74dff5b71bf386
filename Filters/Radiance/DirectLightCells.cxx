// DirectLight's part for smoke cells: means over cells and over parts of them.
#include "DirectLight.h"

#include "ConvexSolid.h"
#include "NearLights.h"
#include "Places.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

/// Ways to a light that tell how much of it is hidden from a cell near to it, which gets much; and
/// whether anything is: what stands before its faces alone hides nothing from corners and centre.
/// Less than a share hidden is none, since single ways may graze the wall behind a plate.
constexpr std::uint64_t NearShadowWays = 256;
constexpr std::uint64_t ClearWays = 64;
constexpr double LeastHidden = 0.05;
/// Corners of a cell are looked at slightly inside, since cells often end at walls: so far from its
/// centre, in edges.
constexpr double Inside = 0.49;
/// Of a cell that a light's plane goes through, what lies before that begins so far from it, in
/// edges, and at least so many tolerances of the shapes.
constexpr double LeastHeight = 0.0037;
constexpr double LeastHeights = 2.0;

} // namespace

bool DirectLight::Clear(std::size_t light, std::int64_t cell) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  if (const CellPart* part = this->Scene_.Smoke().Parts().Find(cell))
  {
    return std::all_of(part->Fine.begin(), part->Fine.end(),
      [&](const PartSample& sample)
      { return this->Sight_.OfAll(root, part->Centre + Vec3(sample.Offset)) == Sight::Whole; });
  }
  const Vec3 centre = this->Scene_.Smoke().CellCentre(cell);
  const Vec3 size = this->Scene_.Smoke().CellSize(cell);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 shift(
      corner & 1 ? Inside : -Inside, corner & 2 ? Inside : -Inside, corner & 4 ? Inside : -Inside);
    if (this->Sight_.OfCorners(root, centre + shift * size) != Sight::Whole)
    {
      return false;
    }
  }
  return this->Sight_.OfAll(root, centre) == Sight::Whole &&
         this->ShownShare(light, cell, ClearWays) > 1.0 - LeastHidden;
}

bool DirectLight::ClearBefore(std::size_t light, std::int64_t cell) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light);
  if (!root.Plane() || this->Scene_.Smoke().Parts().Find(cell))
  {
    return false;
  }
  const Box cellBox = this->Scene_.Smoke().BoxOf(cell);
  const Vec3 inset = (0.5 - Inside) * cellBox.Size();
  const Box box{cellBox.Lower + inset, cellBox.Upper - inset};
  // Of a cell that the plane cuts, what lies before it.
  const double least = std::max(LeastHeight * glm::dot(glm::abs(root.Normal), cellBox.Size()),
    LeastHeights * this->Scene_.Shapes().Tolerance());
  const ConvexSolid before =
    ConvexSolid(box).Cut({root.Normal, glm::dot(root.Normal, root.Centre) + least}).first;
  return !before.Empty() &&
         this->Scene_.Shapes().Free({root.Corners, root.Normal, before.Bounds(), before.Corners()});
}

std::optional<Spectrum> DirectLight::KeptFluence(std::size_t light, std::int64_t cell) const
{
  const int place = this->Near_ ? this->Near_->Place(cell) : -1;
  if (place < 0)
  {
    return std::nullopt;
  }
  const int near = this->Near_->Find(place, light);
  if (near < 0)
  {
    return std::nullopt;
  }
  Spectrum mean{};
  for (int band = 0; band < this->Scene_.Bands(); ++band)
  {
    mean[band] = this->Near_->Mean(place, near, band);
  }
  return mean;
}

LightWays DirectLight::CellWays(std::size_t light) const
{
  return {this->Scene_.Smoke(), this->Scene_.LargestScale(), this->Scene_.Lights().Root(light)};
}

Spectrum DirectLight::NearCellFluence(
  std::size_t light, std::int64_t cell, bool clear, const NearField* kept) const
{
  const Medium& smoke = this->Scene_.Smoke();
  if (const CellPart* part = smoke.Parts().Find(cell))
  {
    return this->SampledFluence(light, *part);
  }
  const double shown = clear ? 1.0 : this->ShownShare(light, cell, NearShadowWays);
  if (shown == 0.0)
  {
    return {};
  }
  BoxLight box{light, cell, this->CellWays(light).DeepeningOf(cell)};
  // In the thickest cells light does not follow what is interpolated, nor behind a border of smoke.
  if (this->BoxDepth(cell, smoke.CellSize(cell)) < DeepestGauss && !this->BehindBorder(box))
  {
    box.Near = kept;
  }
  Spectrum value = this->OwnFluence(box, BoxSplits);
  for (double& each : value)
  {
    each *= shown;
  }
  return value;
}

Spectrum DirectLight::CellFluence(BoxLight light, bool even) const
{
  const LightGroup& root = this->Scene_.Lights().Root(light.Index);
  const Box whole = this->Scene_.Smoke().BoxOf(light.Cell);
  const double sharpness = root.Law.Sharpness();
  const bool splits =
    !light.Far && LargestEdge(whole.Size()) * sharpness > BoxRatio * root.Distance(whole.Centre());
  light.Far = light.Far || (!splits && root.Radius * sharpness <
                                         PathRatio * glm::length(whole.Centre() - root.Centre));
  const Spectrum fluence = this->OwnFluence(light, splits ? BoxSplits : 0);
  return even ? fluence : this->UnevenFluence(light, fluence);
}

Spectrum DirectLight::OwnFluence(const BoxLight& light, int splits) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const Box whole = smoke.BoxOf(light.Cell);
  const std::vector<Box> own =
    smoke.Covered(light.Cell) ? smoke.OwnBoxes(light.Cell) : std::vector<Box>();
  if (own.empty())
  {
    // What is told of a cell that is wholly covered lights nothing.
    return this->LitBoxFluence(light, whole, splits);
  }
  // Ways from the cell's centre tell little of those from what is left of it: light comes in from
  // the finer grids, from whatever smoke they hold.
  const Vec3 from = whole.Centre() - this->Scene_.Lights().Root(light.Index).Centre;
  Spectrum sum{};
  double volume = 0.0;
  for (const Box& box : own)
  {
    BoxLight part = light;
    part.Far = false;
    part.Ways = light.Ways.Moved(from, box.Centre() - whole.Centre());
    part.Ways.Border = std::numeric_limits<double>::max();
    part.Ways.Entry =
      glm::max(part.Ways.Entry, Vec3(static_cast<double>(smoke.Extinction(light.Cell))));
    const Spectrum value = this->LitBoxFluence(part, box, splits);
    volume += box.Volume();
    for (int band = 0; band < this->Scene_.Bands(); ++band)
    {
      sum[band] += box.Volume() * value[band];
    }
  }
  for (double& value : sum)
  {
    value /= volume;
  }
  return sum;
}

Spectrum DirectLight::PartFluence(std::size_t light, const CellPart& part) const
{
  const std::optional<Spectrum> kept = this->KeptFluence(light, part.Number);
  return kept ? *kept : this->SampledFluence(light, part);
}

Spectrum DirectLight::SampledFluence(std::size_t light, const CellPart& part) const
{
  const Medium& smoke = this->Scene_.Smoke();
  const LightGroup& root = this->Scene_.Lights().Root(light);
  const double distance = root.Distance(part.Centre);
  const double edge = LargestEdge(part.Size);
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
    const Vec3 size = bounds.Size();
    std::vector<Vec3> inside;
    ForEachPlace({boxes, boxes, boxes},
      [&](const std::array<int, 3>& place)
      {
        const Vec3 middle = Vec3(place[0], place[1], place[2]) + 0.5;
        const Vec3 point = bounds.Lower + middle / static_cast<double>(boxes) * size;
        if (smoke.Parts().Locate(part.Cell, point) == part.Number)
        {
          inside.push_back(point);
        }
      });
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

} // namespace smokevis
