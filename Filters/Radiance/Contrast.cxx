#include "Contrast.h"

#include "PixelMoments.h"
#include "SignSight.h"
#include "SignVeil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Standard error of the contrast above which the veil is gathered.
constexpr double UncertainContrast = 0.005;
/// Square of the change of optical depth over a zone, along either edge, that is counted at most:
/// beyond it means of exponentials are no quadratics.
constexpr double MostSquaredChange = 1.0;
/// A sign whose parts are all fainter than this share of the observer's own noise is not worth
/// gathering for: it stands out by a hundredth at most.
constexpr double FaintShare = 0.01;

double BandWeight(const View& view, int band)
{
  return view.TheScene().Bands() == 1 ? 1.0 : PhotopicWeights[band];
}

/// One look at a sign.
class SignLook
{
public:
  SignLook(const View& view, std::size_t sign, const Vec3& eye, const Observer& observer)
      : View_(view), Lights_(view.TheScene().Lights()), Plate_(Lights_.Signs()[sign]), Eye_(eye),
        Observer_(observer), Bands_(view.TheScene().Bands()),
        Sight_(view, Plate_, eye, observer.Acuity)
  {
  }

  SignMeasurement Measure(double cutOff);

private:
  /// Optical depth at 633 nm of the smoke before a zone's middle.
  double DepthOf(const SignSight::Zone& zone) const;
  /// Of each zone of a part, the squares of that depth's changes over it along both edges of the
  /// plate, together, as its neighbours tell; 0 where pixels average them.
  std::vector<double> SquaredChanges(
    const SignSight::Part& part, const std::vector<double>& depths) const;
  SeenBlock SeenThrough(
    const Facet& facet, const SignSight::Zone& zone, double depth, double squaredChange);
  /// The light of the sign itself, as it arrives from each block.
  void FillFactors();
  void MakeVeils();
  void AddVeils();
  void FillMeans();
  /// Finds contrasts of what the blocks show, and the mean.
  void FillContrast();
  /// Adds the veils, and finds contrasts and all that depends on them.
  void FillResult();

  const View& View_;
  const EmitterSet& Lights_;
  const Sign& Plate_;
  const Vec3& Eye_;
  const Observer& Observer_;
  int Bands_;
  SignSight Sight_;
  /// Of each part.
  std::vector<std::vector<SeenBlock>> Blocks_;
  /// Of each band.
  std::vector<std::unique_ptr<SignVeil>> Veils_;
  SignMeasurement Result_;
};

double SignLook::DepthOf(const SignSight::Zone& zone) const
{
  const Vec3 way = this->Sight_.Places()[zone.Place].Point - this->Eye_;
  const double distance = glm::length(way);
  return this->View_.TheScene().Smoke().OpticalDepth(this->Eye_, way / distance, 0.0, distance);
}

std::vector<double> SignLook::SquaredChanges(
  const SignSight::Part& part, const std::vector<double>& depths) const
{
  const std::vector<SignSight::Zone>& zones = part.Zones;
  std::vector<double> changes(zones.size(), 0.0);
  if (!this->Sight_.Resolved())
  {
    return changes;
  }
  std::array<std::size_t, 2> size{};
  for (const SignSight::Zone& zone : zones)
  {
    size = {std::max(size[0], zone.At[0] + 1), std::max(size[1], zone.At[1] + 1)};
  }
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> numbers(size[0] * size[1], none);
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    numbers[zones[i].At[0] + size[0] * zones[i].At[1]] = i;
  }
  // Over a zone, if it is that to its neighbour's middle.
  const auto change = [&](std::size_t zone, std::size_t neighbour, int axis)
  {
    if (neighbour == none)
    {
      return 0.0;
    }
    const double distance = std::abs(this->Sight_.Places()[zones[neighbour].Place].OnPlate[axis] -
                                     this->Sight_.Places()[zones[zone].Place].OnPlate[axis]);
    return distance > 0.0 ? zones[zone].Size[axis] * (depths[neighbour] - depths[zone]) / distance
                          : 0.0;
  };
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const std::size_t at = zones[i].At[axis];
      const std::size_t step = axis == 0 ? 1 : size[0];
      const std::size_t here = zones[i].At[0] + size[0] * zones[i].At[1];
      const std::size_t before = at > 0 ? numbers[here - step] : none;
      const std::size_t behind = at + 1 < size[axis] ? numbers[here + step] : none;
      const double first = change(i, before, axis);
      const double last = change(i, behind, axis);
      // Where smoke begins or is uneven, one side tells nothing of the other.
      const double both = before == none   ? last * last
                          : behind == none ? first * first
                                           : -first * last;
      changes[i] += std::clamp(both, 0.0, MostSquaredChange);
    }
  }
  return changes;
}

SeenBlock SignLook::SeenThrough(
  const Facet& facet, const SignSight::Zone& zone, double depth, double squaredChange)
{
  SeenBlock block{};
  Coefficients& factors = block.Factors;
  const SeenPlace& place = this->Sight_.Places()[zone.Place];
  const Scene& scene = this->View_.TheScene();
  const Vec3 direction = glm::normalize(place.Point - this->Eye_);
  const double relative = this->Lights_.CellLaw(facet.Luminous.value_or(zone.Cell))
                            .Relative(-direction, -glm::dot(direction, facet.Normal));
  for (int band = 0; band < this->Bands_; ++band)
  {
    const double share = BandWeight(this->View_, band);
    const double scale = scene.ExtinctionScale(band);
    const double bandDepth = scale * depth;
    // What an optical depth lets through that goes straight from side to side.
    const double transmitted =
      share * std::exp(-bandDepth) * (1.0 + scale * scale * squaredChange / 24.0);
    block.Spread[1 + band] = scale * std::sqrt(squaredChange / 12.0);
    block.Spread[1 + MaxBands + band] = block.Spread[1 + band];
    Lanes multiple;
    double steady = 0.0;
    if (zone.Reflects)
    {
      const double illuminance = this->View_.Illuminance(
        scene.SurfacePatches() + zone.Cell, 0, place.Point, facet.Normal, band, multiple);
      steady = illuminance - Mean(multiple);
    }
    for (int batch = 0; batch < Batches; ++batch)
    {
      factors[batch][1 + band] = transmitted * relative;
      factors[batch][1 + MaxBands + band] =
        transmitted * (steady + multiple[batch]) / glm::pi<double>();
    }
    this->Result_.OpticalDepth += place.Weight / this->Sight_.Seen() * share * bandDepth;
  }
  return block;
}

void SignLook::FillFactors()
{
  for (const SignSight::Part& part : this->Sight_.Parts())
  {
    std::vector<double> depths(part.Zones.size());
    std::transform(part.Zones.begin(), part.Zones.end(), depths.begin(),
      [this](const SignSight::Zone& zone) { return this->DepthOf(zone); });
    const std::vector<double> changes = this->SquaredChanges(part, depths);
    std::vector<SeenBlock> zones;
    for (std::size_t i = 0; i < part.Zones.size(); ++i)
    {
      zones.push_back(this->SeenThrough(part.Front, part.Zones[i], depths[i], changes[i]));
    }
    std::vector<SeenBlock>& blocks = this->Blocks_.emplace_back();
    for (std::size_t i = 0; i < part.Densities.size(); ++i)
    {
      blocks.push_back(part.Densities[i] > 0.0 ? zones[part.ZoneOf[i]] : SeenBlock{});
      blocks.back().Density = part.Densities[i];
    }
  }
}

void SignLook::MakeVeils()
{
  const std::vector<SeenPlace>& places = this->Sight_.Places();
  for (int band = 0; band < this->Bands_; ++band)
  {
    if (this->Sight_.PartlyHidden())
    {
      this->Veils_.push_back(std::make_unique<ShownVeil>(this->View_, this->Eye_, band, places));
    }
    else
    {
      this->Veils_.push_back(std::make_unique<PlateVeil>(this->View_, this->Eye_, band, places,
        this->Plate_, this->Sight_.Across(), this->Sight_.Up()));
    }
  }
}

void SignLook::AddVeils()
{
  std::vector<DoubleLanes> veils(this->Sight_.Places().size());
  for (std::size_t place = 0; place < veils.size(); ++place)
  {
    for (int band = 0; band < this->Bands_; ++band)
    {
      const Lanes veil = this->Veils_[band]->At(place);
      for (int batch = 0; batch < Batches; ++batch)
      {
        veils[place][batch] += BandWeight(this->View_, band) * veil[batch];
      }
    }
  }
  for (std::size_t index = 0; index < this->Blocks_.size(); ++index)
  {
    const SignSight::Part& part = this->Sight_.Parts()[index];
    for (std::size_t i = 0; i < part.Densities.size(); ++i)
    {
      for (int batch = 0; batch < Batches && part.Densities[i] > 0.0; ++batch)
      {
        this->Blocks_[index][i].Factors[batch][0] = veils[part.Zones[part.ZoneOf[i]].Place][batch];
      }
    }
  }
}

void SignLook::FillMeans()
{
  double lit = 0.0;
  double litWeight = 0.0;
  double unlit = 0.0;
  Lanes mean;
  for (std::size_t index = 0; index < this->Blocks_.size(); ++index)
  {
    const PlatePattern& pattern = this->Sight_.Parts()[index].Pattern;
    for (std::size_t i = 0; i < this->Blocks_[index].size(); ++i)
    {
      const SeenBlock& seen = this->Blocks_[index][i];
      const PatternBlock& block = pattern.Blocks()[i];
      const PatternVector factors = MeanFactors(seen.Factors);
      const double litPart = seen.Density * Dot(factors, block.LitSum);
      lit += litPart;
      litWeight += seen.Density * block.LitSum[0];
      unlit += seen.Density * Dot(factors, block.Sum) - litPart;
      for (int batch = 0; batch < Batches; ++batch)
      {
        mean[batch] += static_cast<float>(
          seen.Density * Dot(seen.Factors[batch], block.Sum) / this->Sight_.Seen());
      }
    }
  }
  SignMeasurement& result = this->Result_;
  const double unlitWeight = this->Sight_.Seen() - litWeight;
  result.LitLuminance = litWeight > 0.0 ? std::max(0.0, lit / litWeight) : 0.0;
  result.UnlitLuminance =
    unlitWeight > 1e-12 * this->Sight_.Seen() ? std::max(0.0, unlit / unlitWeight) : 0.0;
  const double difference = result.LitLuminance - result.UnlitLuminance;
  result.WebberContrast = result.UnlitLuminance > 0.0 ? difference / result.UnlitLuminance : 0.0;
  result.UL924Contrast = result.LitLuminance > 0.0 ? difference / result.LitLuminance : 0.0;
  result.MeanLuminanceError = StandardError(mean);
}

void SignLook::FillContrast()
{
  Sums sums;
  for (std::size_t index = 0; index < this->Blocks_.size(); ++index)
  {
    AddPixels(this->Sight_.Parts()[index].Pattern, this->Blocks_[index], sums);
  }
  SignMeasurement& result = this->Result_;
  const ResampledMoments resampled = sums.Get();
  result.MeanLuminance = resampled[0].Mean;
  Jackknife(resampled, 0.0, result.Contrast, result.ContrastError);
  Jackknife(resampled, this->Observer_.DarkLuminance, result.PerceivedContrast,
    result.PerceivedContrastError);
}

void SignLook::FillResult()
{
  this->AddVeils();
  this->FillMeans();
  this->FillContrast();
}

SignMeasurement SignLook::Measure(double cutOff)
{
  if (!(this->Sight_.Seen() > 0.0))
  {
    return {};
  }
  SignMeasurement& result = this->Result_;
  result.InView = true;
  this->FillFactors();
  if (cutOff > 0.0)
  {
    this->FillContrast();
    if (result.PerceivedContrast < cutOff)
    {
      return {.InView = true, .BelowCutOff = true};
    }
  }
  result.VisibleFraction = this->Sight_.VisibleFraction();
  this->MakeVeils();
  this->FillResult();
  const bool uncertain = result.ContrastError > UncertainContrast;
  const bool lost = std::max(result.LitLuminance, result.UnlitLuminance) <
                    FaintShare * this->Observer_.DarkLuminance;
  if (uncertain && !lost)
  {
    for (const std::unique_ptr<SignVeil>& veil : this->Veils_)
    {
      result.Rays += veil->Gather();
    }
    this->FillResult();
  }
  result.LeftUncertain = uncertain && result.Rays == 0;
  return result;
}

} // namespace

SignMeasurement MeasureSign(
  const View& view, std::size_t sign, const Vec3& eye, const Observer& observer, double cutOff)
{
  return SignLook(view, sign, eye, observer).Measure(cutOff);
}

} // namespace smokevis
