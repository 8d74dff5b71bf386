#include "Contrast.h"

#include "DivisionError.h"
#include "PixelMoments.h"
#include "Roughness.h"
#include "SignShadow.h"
#include "SignSight.h"
#include "SignVeil.h"
#include "ZoneChanges.h"
#include "ZoneLight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Standard error of the contrast above which the veil is gathered.
constexpr double UncertainContrast = 0.005;
/// Standard error that uneven smoke leaves the perceived one above which the plate is divided more
/// finely.
constexpr double UnevenContrast = 0.002;
/// Roughness of the optical depths over a plate, over their mean where that is below one, above
/// which the veil is told by a ray to each zone, as long as it is above the light field's
/// tolerance.
constexpr double LargestRoughness = 0.03;
/// The same of these depths and of the veil that nine rays tell, over its mean, where both are
/// above it and a third of the tolerance: lamps make veils rougher than depths are.
constexpr double LeastRoughness = 0.01;
/// Mean of these depths below which veils are so faint that they are told as at this one.
constexpr double FaintDepth = 0.1;
/// Zones of a plate behind uneven smoke above which the veil is not told by a ray to each.
constexpr std::size_t MostRays = 1024;
/// Change of optical depth over a zone, along either edge, that is counted at most: beyond it means
/// of exponentials are no quadratics. Also of what is unknown of it.
constexpr double MostChange = 1.0;
/// A sign whose parts are all fainter than this share of the observer's own noise is not worth
/// gathering for: it stands out by a hundredth at most.
constexpr double FaintShare = 0.01;

double BandWeight(const View& view, int band)
{
  return view.TheScene().Bands() == 1 ? 1.0 : PhotopicWeights[band];
}

/// Standard deviation of what changes evenly from one side of a zone to the other.
glm::dvec2 SpreadOf(const glm::dvec2& change)
{
  return change / std::sqrt(12.0);
}

/// One look at a sign.
class SignLook
{
public:
  /// @param blocks of the plate (SignSight)
  SignLook(
    const View& view, std::size_t sign, const Vec3& eye, const Observer& observer, double blocks)
      : View_(view), Lights_(view.TheScene().Lights()), Plate_(Lights_.Signs()[sign]), Eye_(eye),
        Observer_(observer), Bands_(view.TheScene().Bands()), Fine_(blocks > UsualBlocks),
        Sight_(view, Plate_, eye, observer.Acuity, blocks)
  {
  }

  /// None where uneven smoke calls for more blocks.
  std::optional<SignMeasurement> Measure(double cutOff);

private:
  /// Optical depth at 633 nm of the smoke before a place.
  double DepthBefore(const SeenPlace& place) const;
  /// Whether smoke on the way to its middle emits light.
  bool GlowsBefore(const SignSight::Zone& zone) const;
  /// What comes through the smoke before a zone, without its own light.
  /// @param change of the depth over the zone (ZoneChanges)
  SeenBlock SeenThrough(const SignSight::Part& part, std::size_t index, const ZoneLight& light,
    double depth, const glm::dvec2& change);
  /// The light of the sign itself, as it arrives from each block.
  void FillFactors();
  std::unique_ptr<SignVeil> MakeVeil(int band) const;
  void AddVeils();
  void FillMeans();
  /// Finds contrasts of what the blocks show, and the mean.
  /// @return the sums over their pixels
  Sums FillContrast();
  /// Finds what uneven smoke leaves unknown of these contrasts.
  void FillDivisionErrors(const Sums& sums);
  /// Adds the veils, and finds contrasts and all that depends on them.
  void FillResult();

  const View& View_;
  const EmitterSet& Lights_;
  const Sign& Plate_;
  const Vec3& Eye_;
  const Observer& Observer_;
  int Bands_;
  bool Fine_;
  SignSight Sight_;
  /// Of each part.
  std::vector<std::vector<SeenBlock>> Blocks_;
  std::vector<ZoneChanges> Changes_;
  /// Optical depths at 633 nm before all places.
  std::vector<double> Depths_;
  /// Changes of the optical depth at 633 nm over the zones of each part.
  std::vector<std::vector<glm::dvec2>> DepthChanges_;
  /// What is unknown of the zones of each part, in the band of the largest extinction.
  std::vector<std::vector<ZoneError>> Unknown_;
  /// Whether smoke that emits light lies before the plate.
  bool Glows_ = false;
  /// Of each band.
  std::vector<std::unique_ptr<SignVeil>> Veils_;
  SignMeasurement Result_;
};

double SignLook::DepthBefore(const SeenPlace& place) const
{
  const Vec3 way = place.Point - this->Eye_;
  const double distance = glm::length(way);
  return this->View_.TheScene().Smoke().OpticalDepth(this->Eye_, way / distance, 0.0, distance);
}

bool SignLook::GlowsBefore(const SignSight::Zone& zone) const
{
  const Medium& smoke = this->View_.TheScene().Smoke();
  if (!smoke.Emits())
  {
    return false;
  }
  const Vec3 way = this->Sight_.Places()[zone.Place].Point - this->Eye_;
  const double distance = glm::length(way);
  std::vector<Segment> pieces;
  smoke.WalkSmoke(this->Eye_, way / distance, 0.0, distance, pieces);
  return std::any_of(pieces.begin(), pieces.end(),
    [&smoke](const Segment& piece) { return smoke.EmittedLuminance(piece.Cell) > 0.0F; });
}

SeenBlock SignLook::SeenThrough(const SignSight::Part& part, std::size_t index,
  const ZoneLight& light, double depth, const glm::dvec2& change)
{
  const SignSight::Zone& zone = part.Zones[index];
  const Facet& facet = part.Front;
  const double squaredChange = glm::dot(change, change);
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
    const glm::dvec2 dims = scale * change;
    block.Spread[1 + band] = -SpreadOf(dims);
    for (int batch = 0; batch < Batches; ++batch)
    {
      factors[batch][1 + band] = transmitted * relative;
    }
    if (zone.Reflects)
    {
      const ZoneLight::Illuminance& lit = light.At(index, band);
      // Lamps close by light one end of a zone more than the other.
      const glm::dvec2 lights = glm::clamp(lit.Change, -MostChange, MostChange);
      const double together = 1.0 - glm::dot(dims, lights) / 12.0;
      block.Spread[1 + MaxBands + band] = SpreadOf(lights - dims);
      for (int batch = 0; batch < Batches; ++batch)
      {
        factors[batch][1 + MaxBands + band] =
          transmitted * together * (lit.Direct + lit.Multiple[batch]) / glm::pi<double>();
      }
    }
    this->Result_.OpticalDepth += place.Weight / this->Sight_.Seen() * share * bandDepth;
  }
  return block;
}

void SignLook::FillFactors()
{
  const std::vector<SeenPlace>& places = this->Sight_.Places();
  std::transform(places.begin(), places.end(), std::back_inserter(this->Depths_),
    [this](const SeenPlace& place) { return this->DepthBefore(place); });
  for (const SignSight::Part& part : this->Sight_.Parts())
  {
    std::vector<double> depths(part.Zones.size());
    std::transform(part.Zones.begin(), part.Zones.end(), depths.begin(),
      [this](const SignSight::Zone& zone) { return this->Depths_[zone.Place]; });
    this->Glows_ =
      this->Glows_ || std::any_of(part.Zones.begin(), part.Zones.end(),
                        [this](const SignSight::Zone& zone) { return this->GlowsBefore(zone); });
    std::vector<glm::dvec2> changes = this->Changes_.emplace_back(this->Sight_, part).Of(depths);
    for (glm::dvec2& change : changes)
    {
      change = glm::clamp(change, -MostChange, MostChange);
    }
    std::vector<ZoneError>& unknown = this->Unknown_.emplace_back();
    for (const double error : this->Changes_.back().Unevenness(depths))
    {
      unknown.push_back({std::min(MostChange, this->View_.TheScene().LargestScale() * error)});
    }
    const ZoneLight light(this->View_, this->Sight_, part, this->Changes_.back());
    std::vector<SeenBlock> zones;
    zones.reserve(part.Zones.size());
    for (std::size_t i = 0; i < part.Zones.size(); ++i)
    {
      zones.push_back(this->SeenThrough(part, i, light, depths[i], changes[i]));
    }
    this->DepthChanges_.push_back(std::move(changes));
    std::vector<SeenBlock>& blocks = this->Blocks_.emplace_back();
    blocks.reserve(part.Densities.size());
    for (std::size_t i = 0; i < part.Densities.size(); ++i)
    {
      blocks.push_back(part.Densities[i] > 0.0 ? zones[part.ZoneOf[i]] : SeenBlock{});
      blocks.back().Density = part.Densities[i];
    }
  }
}

std::unique_ptr<SignVeil> SignLook::MakeVeil(int band) const
{
  const std::vector<SeenPlace>& places = this->Sight_.Places();
  const bool whole = !this->Sight_.PartlyHidden();
  const std::array<PlateAxis, 2> axes = {
    PlateAxis(this->View_, this->Plate_, this->Sight_.Across(), 0),
    PlateAxis(this->View_, this->Plate_, this->Sight_.Up(), 1)};
  const auto shown = [&]
  {
    return std::make_unique<ShownVeil>(
      this->View_, this->Eye_, band, places, this->Plate_, axes, whole);
  };
  // Before a plate without a pattern its contrast is that of the veil, which falls off right before
  // the plate's rim.
  const bool plain = this->Sight_.Across().Count() * this->Sight_.Up().Count() == 1;
  if (!whole || this->Glows_ || plain)
  {
    return shown();
  }
  // The veil of rough smoke is as rough, which few rays do not tell; of thin smoke it is
  // proportional to the depth.
  const double tolerance = this->View_.Field().Tolerance;
  const double depths = this->View_.TheScene().LargestScale() * Roughness(places, this->Depths_) /
                        std::clamp(this->Result_.OpticalDepth, FaintDepth, 1.0);
  const bool few = places.size() <= MostRays;
  const bool divided = axes[0].IsDivided() || axes[1].IsDivided();
  if (few && (this->Fine_ || divided || depths > std::max(LargestRoughness, tolerance)))
  {
    return shown();
  }
  auto plate = std::make_unique<PlateVeil>(
    this->View_, this->Eye_, band, places, this->Plate_, this->Sight_.Across(), this->Sight_.Up());
  const double least = std::max(LeastRoughness, tolerance / 3.0);
  if (few && std::min(depths, plate->RelativeRoughness()) > least)
  {
    return shown();
  }
  return plate;
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
    std::vector<double> means(part.Zones.size());
    std::transform(part.Zones.begin(), part.Zones.end(), means.begin(),
      [&veils](const SignSight::Zone& zone)
      {
        const DoubleLanes& veil = veils[zone.Place];
        return std::accumulate(veil.begin(), veil.end(), 0.0) / Batches;
      });
    const std::vector<glm::dvec2> changes = this->Changes_[index].Of(means);
    // What smoke scatters changes by no larger share than what comes through it; flames do.
    const std::vector<double> glow = this->Glows_ ? this->Changes_[index].Unevenness(means)
                                                  : std::vector<double>(means.size(), 0.0);
    for (std::size_t zone = 0; zone < means.size(); ++zone)
    {
      ZoneError& unknown = this->Unknown_[index][zone];
      unknown.Veil = std::max(glow[zone], unknown.Depth * means[zone]);
    }
    for (std::size_t i = 0; i < part.Densities.size(); ++i)
    {
      if (!(part.Densities[i] > 0.0))
      {
        continue;
      }
      const std::size_t zone = part.ZoneOf[i];
      const glm::dvec2& depth = this->DepthChanges_[index][zone];
      const double squared = glm::dot(depth, depth);
      // What glows before a sign grows where that is dimmed: a veil that changes with the depth is
      // curved as what comes through is, and goes against it.
      const double along =
        squared > 0.0 && means[zone] > 0.0 ? glm::dot(changes[zone], depth) / means[zone] : 0.0;
      SeenBlock& block = this->Blocks_[index][i];
      block.Spread[0] = squared > 0.0 ? SpreadOf(along / squared * depth) : glm::dvec2(0.0);
      for (int batch = 0; batch < Batches; ++batch)
      {
        block.Factors[batch][0] = veils[part.Zones[zone].Place][batch] * (1.0 - along / 24.0);
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
  const bool hasUnlit = unlitWeight > 1e-12 * this->Sight_.Seen();
  result.LitLuminance = litWeight > 0.0 ? std::max(0.0, lit / litWeight) : 0.0;
  result.UnlitLuminance = hasUnlit ? std::max(0.0, unlit / unlitWeight) : 0.0;
  const double difference = result.LitLuminance - result.UnlitLuminance;
  result.WebberContrast = result.UnlitLuminance > 0.0 ? difference / result.UnlitLuminance : 0.0;
  result.UL924Contrast =
    hasUnlit && result.LitLuminance > 0.0 ? difference / result.LitLuminance : 0.0;
  result.MeanLuminanceError = StandardError(mean);
}

Sums SignLook::FillContrast()
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
  return sums;
}

void SignLook::FillDivisionErrors(const Sums& sums)
{
  DivisionError division;
  for (std::size_t index = 0; index < this->Blocks_.size(); ++index)
  {
    const SignSight::Part& part = this->Sight_.Parts()[index];
    division.Add(part.Pattern, this->Blocks_[index], part.ZoneOf, this->Unknown_[index]);
  }
  const Moments moments = sums.Get()[0];
  this->Result_.ContrastDivisionError = division.OfRatio(moments, sums.Weight, 0.0);
  this->Result_.PerceivedContrastDivisionError =
    division.OfRatio(moments, sums.Weight, this->Observer_.DarkLuminance);
}

void SignLook::FillResult()
{
  this->AddVeils();
  this->FillMeans();
  this->FillDivisionErrors(this->FillContrast());
}

std::optional<SignMeasurement> SignLook::Measure(double cutOff)
{
  if (!(this->Sight_.Seen() > 0.0))
  {
    return SignMeasurement{};
  }
  SignMeasurement& result = this->Result_;
  result.InView = true;
  this->FillFactors();
  if (cutOff > 0.0)
  {
    this->FillContrast();
    if (result.PerceivedContrast < cutOff)
    {
      return SignMeasurement{.InView = true, .BelowCutOff = true};
    }
  }
  result.Clear = this->Sight_.Clear();
  result.VisibleFraction = this->Sight_.VisibleFraction();
  for (int band = 0; band < this->Bands_; ++band)
  {
    this->Veils_.push_back(this->MakeVeil(band));
  }
  this->FillResult();
  if (!this->Fine_ && result.PerceivedContrastDivisionError > UnevenContrast)
  {
    return std::nullopt;
  }
  const bool lost = std::max(result.LitLuminance, result.UnlitLuminance) <
                    FaintShare * this->Observer_.DarkLuminance;
  const bool uncertain = result.ContrastError > UncertainContrast;
  if (uncertain && !lost)
  {
    for (const std::unique_ptr<SignVeil>& veil : this->Veils_)
    {
      result.Rays += veil->Gather();
    }
    this->FillResult();
  }
  result.LeftUncertain = uncertain && result.Rays == 0;
  result.Uneven = this->Fine_;
  return result;
}

} // namespace

SignMeasurement MeasureSign(
  const View& view, std::size_t sign, const Vec3& eye, const Observer& observer, double cutOff)
{
  const Sign& plate = view.TheScene().Lights().Signs()[sign];
  if (view.Skips().HiddenSigns && InShadowOfSurfaces(view, plate, eye))
  {
    return {.InShadow = true};
  }
  const std::optional<SignMeasurement> usual =
    SignLook(view, sign, eye, observer, UsualBlocks).Measure(cutOff);
  return usual ? *usual : SignLook(view, sign, eye, observer, ManyBlocks).Measure(cutOff).value();
}

} // namespace smokevis
