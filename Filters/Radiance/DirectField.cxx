#include "DirectField.h"

#include "LightQuadrature.h"
#include "Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Optical depth across a cell below which its light is flat enough.
constexpr double FlatDepth = 0.41;
/// Share of a cell's fluence below which what is left of it without the near lights' is rounding.
constexpr double Rounding = 1e-6;
/// Cosine of the angle to an axis up to which a plate faces along it.
constexpr double NearlyAlongAxis = 0.999;

/// The planes of plates that face along an axis: there their light falls off to nothing.
class LightPlanes
{
public:
  explicit LightPlanes(const EmitterSet& lights)
  {
    for (std::size_t light = 0; light < lights.Lights().size(); ++light)
    {
      const LightGroup& root = lights.Root(light);
      for (int axis = 0; axis < 3; ++axis)
      {
        if (std::abs(root.Normal[axis]) > NearlyAlongAxis && root.Plane() && !root.Law.Measured())
        {
          this->Places_[Index(axis, root.Normal[axis] > 0.0 ? 0 : 1)].push_back(root.Centre[axis]);
        }
      }
    }
    for (std::vector<double>& places : this->Places_)
    {
      std::sort(places.begin(), places.end());
    }
  }

  /// Whether one lies between the middle of a box and half the box beyond a side of it, and faces
  /// the box.
  bool AtEndOf(const Box& box, int axis, int side) const
  {
    const double middle = box.Centre()[axis];
    const double beyond = middle + (side == 0 ? -1.0 : 1.0) * box.Size()[axis];
    const std::vector<double>& places = this->Places_[Index(axis, side)];
    const auto first = std::lower_bound(places.begin(), places.end(), std::min(middle, beyond));
    return first != places.end() && *first <= std::max(middle, beyond);
  }

private:
  /// Of plates that face away from a side of cells.
  static int Index(int axis, int side) { return 2 * axis + side; }

  std::array<std::vector<double>, 6> Places_;
};

} // namespace

DirectField::DirectField(const Scene& scene, const LightField& field)
    : Scene_(scene), Field_(field), Direct_(scene), Cells_(field.Cells),
      Means_(field.DirectFluence), Shapes_(field.Bands)
{
  if (scene.Smoke().Empty() || scene.Albedo() == 0.0)
  {
    return;
  }
  this->Lights_ = &scene.Near(field.Tolerance);
  tbb::parallel_for(std::size_t{0}, scene.Lights().Lights().size(),
    [this](std::size_t light) { this->Lights_->Deposit(light); });
  this->FindOthers();
  const auto alike = [this](std::int64_t cell, std::int64_t other)
  {
    if (!this->Near(other))
    {
      return false;
    }
    const auto& first = this->Lights_->Cells()[this->Lights_->Place(cell)].Lights;
    const auto& second = this->Lights_->Cells()[this->Lights_->Place(other)].Lights;
    return std::equal(first.begin(), first.end(), second.begin(), second.end(),
      [](const NearLights::Light& one, const NearLights::Light& two)
      { return one.Index == two.Index; });
  };
  this->FindVarying();
  const LightPlanes planes(scene.Lights());
  for (int band = 0; band < field.Bands; ++band)
  {
    const float* all = field.DirectFluence.data() + field.CellIndex(band, 0);
    const float* others = this->Means_.data() + field.CellIndex(band, 0);
    this->Shapes_[band] = CellShape(
      scene,
      [&](std::int64_t cell, std::int64_t other)
      {
        // Without its near lights, a cell is like those that lack the same.
        return !this->Near(cell) ? all[other] : alike(cell, other) ? others[other] : 0.0F;
      },
      [&](std::int64_t cell, int axis, int side)
      { return planes.AtEndOf(scene.Smoke().CellBounds(cell), axis, side); });
  }
}

void DirectField::FindOthers()
{
  const std::vector<NearLights::Cell>& cells = this->Lights_->Cells();
  const std::size_t lights = this->Scene_.Lights().Lights().size();
  tbb::parallel_for(std::size_t{0}, cells.size(),
    [&](std::size_t i)
    {
      for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
      {
        float& mean = this->Means_[band * this->Cells_ + cells[i].Index];
        double others = mean;
        for (std::size_t light = 0; light < cells[i].Lights.size(); ++light)
        {
          others -= this->Lights_->Mean(i, light, static_cast<int>(band));
        }
        mean = cells[i].Lights.size() == lights || others < Rounding * mean
                 ? 0.0F
                 : static_cast<float>(others);
      }
    });
}

void DirectField::FindVarying()
{
  const Medium& smoke = this->Scene_.Smoke();
  this->Variation_.assign(this->Shapes_.size() * this->Cells_, Variation::Flat);
  for (std::size_t band = 0; band < this->Shapes_.size(); ++band)
  {
    for (std::size_t i = 0; i < this->Cells_; ++i)
    {
      const auto cell = static_cast<std::int64_t>(i);
      const Vec3 size = smoke.CellSize(cell);
      const double depth = smoke.Extinction(cell) * LargestEdge(size) *
                           this->Scene_.ExtinctionScale(static_cast<int>(band));
      const std::size_t index = band * this->Cells_ + i;
      const int near = this->Lights_->Place(cell);
      const bool close = near >= 0 && this->Lights_->Cells()[near].Close;
      // In the thickest cells parts would not follow the light; means keep the balance of power.
      if (this->Field_.DirectFluence[index] > 0.0F && depth > 0.0 && depth < MostParts * PartDepth)
      {
        this->Variation_[index] = depth > FlatDepth ? Variation::Thick
                                  : close           ? Variation::Close
                                                    : Variation::Flat;
      }
    }
  }
}

double DirectField::NearFluence(std::int64_t cell, const Vec3& origin, const Vec3& direction,
  double begin, double end, double place, int band) const
{
  const bool thick = this->Variation_[band * this->Cells_ + cell] == Variation::Thick;
  const int index = this->Lights_->Place(cell);
  const std::vector<NearLights::Light>& nearLights = this->Lights_->Cells()[index].Lights;
  // Shadows and sharp beams would cost more than lines are worth, and what is not close is flat:
  // means do.
  const auto varies = [&](const NearLights::Light& light)
  {
    return light.ClearBefore && (light.Close || thick) &&
           this->Lights_->Field(light.Index) != nullptr;
  };
  double sum = 0.0;
  double varying = 0.0;
  for (std::size_t i = 0; i < nearLights.size(); ++i)
  {
    const double mean = this->Lights_->Mean(index, i, band);
    (varies(nearLights[i]) ? varying : sum) += mean;
  }
  // One light stands for all that vary, as often as it has a share in their mean; where it was
  // found among them is as random as the place.
  double before = 0.0;
  for (std::size_t i = 0; i < nearLights.size(); ++i)
  {
    const double mean = varies(nearLights[i]) ? this->Lights_->Mean(index, i, band) : 0.0;
    if (!(mean > 0.0) || place * varying >= before + mean)
    {
      before += mean;
      continue;
    }
    const LightGroup& root = this->Scene_.Lights().Root(nearLights[i].Index);
    const double share = std::clamp((place * varying - before) / mean, 0.0, 1.0);
    const auto [distance, step] = Equiangular(root, origin, direction).At(begin, end, share);
    const NearField& field = *this->Lights_->Field(nearLights[i].Index);
    return sum + varying / mean * step / (end - begin) *
                   field.Fluence(origin + distance * direction, band);
  }
  return sum;
}

double DirectField::NearVeil(std::int64_t cell, const Vec3& origin, const Vec3& direction,
  double begin, double end, double extinction, int band) const
{
  double sum = 0.0;
  for (const NearLights::Light& near : this->Lights_->Cells()[this->Lights_->Place(cell)].Lights)
  {
    const LightGroup& root = this->Scene_.Lights().Root(near.Index);
    const NearField* field = this->Lights_->Field(near.Index);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    LightQuadrature(root, field ? field->PatternLength() : infinity, origin, direction, extinction)
      .ForEach(begin, end,
        [&](double distance, double step)
        {
          const Vec3 point = origin + distance * direction;
          const double fluence = near.ClearBefore && field ? field->Fluence(point, band)
                                                           : this->Direct_.Fluence(near.Index,
                                                               point, near.ClearBefore)[band];
          sum += fluence * step * extinction * std::exp(-extinction * (distance - begin));
        });
  }
  return sum * this->Scene_.Albedo() / (4.0 * glm::pi<double>());
}

} // namespace smokevis
