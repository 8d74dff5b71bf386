#include "DirectField.h"

#include "GaussNodes.h"
#include "Scene.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// Optical depth across a cell below which its light is flat enough, that of the pieces that
/// thicker ones are cut into, and most pieces of one.
constexpr double FlatDepth = 0.41;
constexpr double PieceDepth = 0.5;
constexpr int MostPieces = 8;
/// A piece of a ray into a plate is cut so much closer to the plate: behind, the light follows the
/// pattern.
constexpr double Grading = 0.25;
/// Length over height of such a last part up to which it is not halved, wherever it ends.
constexpr double LongestSteep = 2.0;
/// Parts of a piece of a ray are halved so often at most.
constexpr int MostHalvings = 3;
/// Largest parts that Gauss points of some number serve: their length over the distance from the
/// plate's edges, or, so many radii away from the light and one from its edges, the angle that they
/// span there; and their optical depth. Close to the light its fluence is smooth but at the edges
/// (it follows a solid angle, a harmonic function): the error of n points goes with rho^-2n of the
/// Bernstein ellipse through the nearest edge (Trefethen 2013), 1e-3 for four points beside it. Far
/// away the rules' errors are angle^2 / 24 and angle^4 / 4320.
constexpr double FarRadii = 1.5;
struct PartLimit
{
  double Length, Angle, Depth;
};
constexpr PartLimit OnePointPart = {0.25, 0.15, 0.15};
constexpr PartLimit TwoPointPart = {1.33, 0.8, 0.8};
constexpr PartLimit FourPointPart = {2.0, 2.0, 1.0};

/// Share of a cell's fluence below which what is left of it without the near lights' is rounding.
constexpr double Rounding = 1e-6;

struct GaussRule
{
  int Count;
  std::array<double, 4> Nodes, Weights;
};
constexpr GaussRule OnePoint = {1, {0.5}, {1.0}};
constexpr GaussRule TwoPoints = {2, {Nodes2[0], Nodes2[1]}, {0.5, 0.5}};
constexpr GaussRule FourPoints = {4, Nodes4, Weights4};

/// Equiangular places about a light follow 1/d^2 along a ray (Kulla and Fajardo 2012); a light of
/// some size is no steeper than its radius.
class Equiangular
{
public:
  Equiangular(const LightGroup& light, const Vec3& origin, const Vec3& direction)
      : Middle_(glm::dot(light.Centre - origin, direction)),
        Aside_(glm::length(origin + Middle_ * direction - light.Centre)),
        Width_(std::max({Aside_, 0.5 * light.Radius, 1e-9}))
  {
  }

  struct Place
  {
    /// Along the ray, and the length that it stands for.
    double Distance, Step;
  };
  /// The place at a share of the angle between two distances.
  Place At(double from, double to, double share) const
  {
    const double low = this->Angle(from);
    return this->Between(low, this->Angle(to), from, to, share);
  }
  /// Calls visit(distance along the ray, step) for the places of a rule between two distances.
  template <class Visit>
  void ForEach(const GaussRule& rule, double from, double to, Visit&& visit) const
  {
    const double low = this->Angle(from);
    const double high = this->Angle(to);
    for (int i = 0; i < rule.Count; ++i)
    {
      const Place place = this->Between(low, high, from, to, rule.Nodes[i]);
      visit(place.Distance, rule.Weights[i] * place.Step);
    }
  }
  double Angle(double distance) const
  {
    return std::atan((distance - this->Middle_) / this->Width_);
  }
  /// Whether a part of the ray stays farther from the light's centre than some distance.
  bool Beyond(double distance, double from, double to) const
  {
    const double along = std::max({from - this->Middle_, this->Middle_ - to, 0.0});
    return this->Aside_ * this->Aside_ + along * along > distance * distance;
  }

private:
  Place Between(double low, double high, double from, double to, double share) const
  {
    const double tangent = std::tan(low + (high - low) * share);
    return {std::clamp(this->Middle_ + this->Width_ * tangent, from, to),
      (high - low) * this->Width_ * (1.0 + tangent * tangent)};
  }

  double Middle_, Aside_, Width_;
};

/// Places of a quadrature of a light's fluence along a ray.
class LightQuadrature
{
public:
  LightQuadrature(
    const LightGroup& light, const Vec3& origin, const Vec3& direction, double extinction)
      : Light_(light), Origin_(origin), Direction_(direction), Extinction_(extinction),
        Sharpness_(light.Law.Sharpness()), Places_(light, origin, direction)
  {
  }

  /// Calls visit(distance along the ray, step) for what lies before the light's plate of a piece of
  /// the ray.
  template <class Visit> void ForEach(double begin, double end, Visit&& visit) const
  {
    const double first = this->Height(begin);
    const double last = this->Height(end);
    if (first <= 0.0 && last <= 0.0)
    {
      return;
    }
    const auto at = [&](double share) { return std::min(begin + (end - begin) * share, end); };
    const double plane = at(std::clamp(first / (first - last), 0.0, 1.0));
    const double from = first < 0.0 ? plane : begin;
    const double to = last < 0.0 ? plane : end;
    if (std::max(last, 0.0) >= Grading * first)
    {
      this->ForEachOf(from, to, MostHalvings, visit);
      return;
    }
    const double cut = std::min(at((1.0 - Grading) * first / (first - last)), to);
    this->ForEachOf(from, cut, MostHalvings, visit);
    // A ray that runs along the plate may pass many edges there.
    const bool steep = to - cut <= LongestSteep * this->Height(cut);
    this->ForEachOf(cut, to, steep ? 0 : MostHalvings, visit);
  }

private:
  double Height(double distance) const
  {
    return glm::dot(
      this->Origin_ + distance * this->Direction_ - this->Light_.Centre, this->Light_.Normal);
  }

  template <class Visit> void ForEachOf(double begin, double end, int halvings, Visit&& visit) const
  {
    const double length = end - begin;
    const double middle = 0.5 * (begin + end);
    const double edges = this->Light_.EdgeDistance(this->Origin_ + middle * this->Direction_);
    const bool far = edges >= this->Light_.Radius &&
                     this->Places_.Beyond(FarRadii * this->Light_.Radius, begin, end);
    const double unit = far ? 1.0 : edges;
    const double size = far ? this->Places_.Angle(end) - this->Places_.Angle(begin) : length;
    const auto within = [&](const PartLimit& limit)
    {
      return this->Sharpness_ * size <= unit * (far ? limit.Angle : limit.Length) &&
             this->Extinction_ * length <= limit.Depth;
    };
    if (halvings > 0 && !within(FourPointPart))
    {
      this->ForEachOf(begin, middle, halvings - 1, visit);
      this->ForEachOf(middle, end, halvings - 1, visit);
      return;
    }
    const GaussRule& rule = !within(TwoPointPart)  ? FourPoints
                            : within(OnePointPart) ? OnePoint
                                                   : TwoPoints;
    this->Places_.ForEach(rule, begin, end, visit);
  }

  const LightGroup& Light_;
  Vec3 Origin_, Direction_;
  double Extinction_;
  /// How fast the light changes with the angle, 1 or more.
  double Sharpness_;
  Equiangular Places_;
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
  this->Lights_ = &scene.Near();
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
  for (int band = 0; band < field.Bands; ++band)
  {
    const float* all = field.DirectFluence.data() + field.CellIndex(band, 0);
    const float* others = this->Means_.data() + field.CellIndex(band, 0);
    this->Shapes_[band] = CellShape(scene,
      [&](std::int64_t cell, std::int64_t other)
      {
        // Without its near lights, a cell is like those that lack the same.
        return !this->Near(cell) ? all[other] : alike(cell, other) ? others[other] : 0.0F;
      });
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
      // In the thickest cells pieces would not follow the light; means keep the balance of power.
      if (this->Field_.DirectFluence[index] > 0.0F && depth > 0.0 &&
          depth < MostPieces * PieceDepth)
      {
        this->Variation_[index] = depth > FlatDepth ? Variation::Thick
                                  : close           ? Variation::Close
                                                    : Variation::Flat;
      }
    }
  }
}

int DirectField::Pieces(std::int64_t cell, double length, int band) const
{
  // Thick pieces are cut: the source is flat in each.
  const double depth =
    this->Scene_.Smoke().Extinction(cell) * this->Scene_.ExtinctionScale(band) * length;
  return std::clamp(static_cast<int>(std::ceil(depth / PieceDepth)), 1, MostPieces);
}

double DirectField::PieceFluence(std::int64_t cell, const Vec3& origin, const Vec3& direction,
  double begin, double end, double place, int band) const
{
  const double smooth = this->Smooth(cell, origin + 0.5 * (begin + end) * direction, band);
  return this->Near(cell)
           ? smooth + this->NearFluence(cell, origin, direction, begin, end, place, band)
           : smooth;
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
  { return light.Clear && (light.Close || thick) && this->Lights_->Field(light.Index) != nullptr; };
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
    LightQuadrature(root, origin, direction, extinction)
      .ForEach(begin, end,
        [&](double distance, double step)
        {
          const Vec3 point = origin + distance * direction;
          const double fluence = near.Clear && field
                                   ? field->Fluence(point, band)
                                   : this->Direct_.Fluence(near.Index, point, near.Clear)[band];
          sum += fluence * step * extinction * std::exp(-extinction * (distance - begin));
        });
  }
  return sum * this->Scene_.Albedo() / (4.0 * glm::pi<double>());
}

} // namespace smokevis
