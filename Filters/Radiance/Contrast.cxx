#include "Contrast.h"

#include "PixelMoments.h"
#include "PlateVeil.h"
#include "SignFacets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// Blocks of the plate along its longer side, at least.
constexpr double BlocksAcross = 8.0;
/// Standard error of the contrast above which the veil is gathered.
constexpr double UncertainContrast = 0.005;
/// A sign whose parts are all fainter than this share of the observer's own noise is not worth
/// gathering for: it stands out by a hundredth at most.
constexpr double FaintShare = 0.01;
/// Where a plate spans more pixels than this along an edge all of its detail counts as resolved.
constexpr int MostPixels = 512;
/// Signs of more facets are not cut at edges: their facets are small.
constexpr std::size_t MostCutFacets = 8;

/// Angle that the segment between two points spans at the eye [rad].
double Angle(const Vec3& eye, const Vec3& a, const Vec3& b)
{
  const Vec3 p = a - eye;
  const Vec3 q = b - eye;
  return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
}

double BandWeight(const View& view, int band)
{
  return view.TheScene().Bands() == 1 ? 1.0 : PhotopicWeights[band];
}

/// Borders of blocks along an edge: those of the pattern's columns, and more where they are longer
/// than `largest`.
std::vector<double> BlockBorders(const PlateColumns& columns, double largest)
{
  std::vector<double> borders = {0.0};
  for (std::size_t column = 0; column < columns.Count(); ++column)
  {
    const double from = borders.back();
    const double to = column + 1 == columns.Count() ? 1.0 : columns.Ends[column + 1];
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / largest - 1e-9)));
    for (int part = 1; part <= parts; ++part)
    {
      borders.push_back(part == parts ? to : from + (to - from) * part / parts);
    }
  }
  return borders;
}

PlateColumns ColumnsOf(const EmitterSet& lights, const Sign& sign, int axis)
{
  std::vector<double> borders;
  for (const std::size_t cell : sign.Cells)
  {
    for (const Vec3& vertex : lights.Cells()[cell].Vertices)
    {
      borders.push_back(PlaceOnPlate(sign, vertex)[axis]);
    }
  }
  return PlateColumns(std::move(borders));
}

/// One look at a sign.
class SignLook
{
public:
  SignLook(const View& view, std::size_t sign, const Vec3& eye, const Observer& observer)
      : View_(view), Lights_(view.TheScene().Lights()), Plate_(Lights_.Signs()[sign]), Eye_(eye),
        Observer_(observer), Bands_(view.TheScene().Bands()), Lit_(LitCells(Lights_, Plate_)),
        Across_(ColumnsOf(Lights_, Plate_, 0)), Up_(ColumnsOf(Lights_, Plate_, 1))
  {
    this->EdgeU_ = this->Plate_.Corners[1] - this->Plate_.Corners[0];
    this->EdgeV_ = this->Plate_.Corners[3] - this->Plate_.Corners[0];
  }

  SignMeasurement Measure(double cutOff);

private:
  /// Blocks that light arrives from alike.
  struct Zone
  {
    /// Of what is seen of it: solid angle, and middle.
    double Weight = 0.0;
    glm::dvec2 Middle{0.0};
    /// A cell that it shows.
    std::size_t Cell = 0;
  };
  /// A plane part of the sign as the eye sees it.
  struct Part
  {
    PlatePattern Pattern;
    std::vector<SeenBlock> Blocks;
    /// Middle of what there is of each block.
    std::vector<glm::dvec2> Middles;
    /// The zone of each block.
    std::vector<std::size_t> ZoneOf;
    std::vector<Zone> Zones;
  };

  std::array<int, 2> Pixels() const;
  PlateBorders Borders() const;
  PlatePattern PatternOf(
    const Facet& facet, const std::array<int, 2>& pixels, const PlateBorders& borders) const;
  /// What is seen of the facets in whole blocks, a zone each.
  std::vector<Part> WholeParts(const std::vector<Facet>& facets, const std::array<int, 2>& pixels,
    const PlateBorders& borders);
  /// The same where something hides a part: blocks are halved there, and stay one zone.
  std::vector<Part> CutParts(const std::vector<Facet>& facets, const std::vector<PlateLook>& looks,
    const std::vector<std::vector<glm::dvec2>>& odd, const PlateBorders& borders);
  Vec3 PointOf(const Facet& facet, const glm::dvec2& place) const
  {
    return OnFacet(this->Lights_, this->Plate_, facet, place);
  }
  /// Share of a block's places that the eye sees.
  double VisibleShare(const Facet& facet, const PatternBlock& block) const;
  double DensityOf(const Facet& facet, const Vec3& point) const;
  /// @param shares of the blocks that are seen; none: by the places of each
  void FindVisible(const Facet& facet, const std::vector<double>& shares, Part& part);
  void FillZones(Part& part) const;
  void FillFactors(const Facet& facet, const Zone& zone, bool reflects, Coefficients& factors);
  void FillFactors(const Facet& facet, Part& part);
  void MakeVeils(const std::vector<Facet>& facets, const std::vector<Part>& parts);
  void FillMeans(const std::vector<Part>& parts);
  void AddVeil(std::vector<Part>& parts);
  /// Finds contrasts of what the blocks show, and the mean.
  void FillContrast(const std::vector<Part>& parts);
  /// Whether something hides a part of what faces the eye.
  bool PartlyHidden() const { return this->Seen_ < (1.0 - 1e-9) * this->All_; }
  /// Adds the veil, and finds contrasts and all that depends on it.
  void FillResult(std::vector<Part>& parts);

  const View& View_;
  const EmitterSet& Lights_;
  const Sign& Plate_;
  const Vec3& Eye_;
  const Observer& Observer_;
  int Bands_;
  std::vector<bool> Lit_;
  PlateColumns Across_, Up_;
  Vec3 EdgeU_, EdgeV_;
  /// Of each band, over the plate or, where it is partly hidden, before the zones of all parts.
  std::vector<PlateVeil> Veils_;
  std::vector<ShownVeil> ShownVeils_;
  /// Weights of all that faces the eye and of what it sees of that.
  double All_ = 0.0;
  double Seen_ = 0.0;
  SignMeasurement Result_;
};

/// Pixels of the observer's image along both edges; none where all detail is resolved.
std::array<int, 2> SignLook::Pixels() const
{
  double narrowest = 1e300;
  for (const std::size_t cell : this->Plate_.Cells)
  {
    const std::vector<Vec3>& vertices = this->Lights_.Cells()[cell].Vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      narrowest =
        std::min(narrowest, Angle(this->Eye_, vertices[i], vertices[(i + 1) % vertices.size()]));
    }
  }
  const double acuity = this->Observer_.Acuity;
  const double wide =
    Angle(this->Eye_, OnPlate(this->Plate_, 0.0, 0.5), OnPlate(this->Plate_, 1.0, 0.5)) / acuity;
  const double high =
    Angle(this->Eye_, OnPlate(this->Plate_, 0.5, 0.0), OnPlate(this->Plate_, 0.5, 1.0)) / acuity;
  if (narrowest >= acuity || std::max(wide, high) > MostPixels)
  {
    return {0, 0};
  }
  return {std::max(1, static_cast<int>(wide)), std::max(1, static_cast<int>(high))};
}

PlateBorders SignLook::Borders() const
{
  const double width = glm::length(this->EdgeU_);
  const double height = glm::length(this->EdgeV_);
  const double largest = std::max(width, height) / BlocksAcross;
  return {BlockBorders(this->Across_, largest / width), BlockBorders(this->Up_, largest / height)};
}

PlatePattern SignLook::PatternOf(
  const Facet& facet, const std::array<int, 2>& pixels, const PlateBorders& borders) const
{
  std::vector<PatternCell> cells;
  for (const std::size_t index : facet.Cells)
  {
    const EmitterCell& emitter = this->Lights_.Cells()[index];
    PatternCell cell;
    for (const Vec3& vertex : emitter.Vertices)
    {
      cell.Corners.push_back(PlaceOnPlate(this->Plate_, vertex));
    }
    cell.Value[0] = 1.0;
    for (int band = 0; band < this->Bands_; ++band)
    {
      cell.Value[1 + band] = emitter.Luminance[band];
      cell.Value[1 + MaxBands + band] = emitter.Reflectance[band];
    }
    cell.Lit = this->Lit_[index];
    cells.push_back(std::move(cell));
  }
  return {cells, PatternAxis(borders[0], pixels[0]), PatternAxis(borders[1], pixels[1])};
}

std::vector<SignLook::Part> SignLook::WholeParts(
  const std::vector<Facet>& facets, const std::array<int, 2>& pixels, const PlateBorders& borders)
{
  std::vector<Part> parts;
  for (const Facet& facet : facets)
  {
    parts.push_back({this->PatternOf(facet, pixels, borders), {}, {}, {}, {}});
    Part& part = parts.back();
    this->FindVisible(facet, {}, part);
    part.ZoneOf.resize(part.Blocks.size());
    std::iota(part.ZoneOf.begin(), part.ZoneOf.end(), std::size_t{0});
  }
  return parts;
}

std::vector<SignLook::Part> SignLook::CutParts(const std::vector<Facet>& facets,
  const std::vector<PlateLook>& looks, const std::vector<std::vector<glm::dvec2>>& odd,
  const PlateBorders& borders)
{
  this->All_ = 0.0;
  this->Seen_ = 0.0;
  std::vector<Part> parts;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    PlateBorders halved = borders;
    HalveAtEdges(halved, odd[i], looks[i]);
    parts.push_back({this->PatternOf(facets[i], {0, 0}, halved), {}, {}, {}, {}});
    Part& part = parts.back();
    this->FindVisible(facets[i], SeenShares(halved, looks[i]), part);
    const std::vector<std::size_t> columns = BlocksBefore(borders[0], halved[0]);
    for (const std::size_t row : BlocksBefore(borders[1], halved[1]))
    {
      for (const std::size_t column : columns)
      {
        part.ZoneOf.push_back(column + row * (borders[0].size() - 1));
      }
    }
  }
  return parts;
}

double SignLook::VisibleShare(const Facet& facet, const PatternBlock& block) const
{
  double seen = 0.0;
  double all = 0.0;
  for (const PatternPlace& place : block.Places)
  {
    seen += Sees(this->View_, this->Plate_, this->Eye_, this->PointOf(facet, place.At)) ? place.Area
                                                                                        : 0.0;
    all += place.Area;
  }
  return seen / all;
}

double SignLook::DensityOf(const Facet& facet, const Vec3& point) const
{
  const Vec3 to = this->Eye_ - point;
  const double square = glm::dot(to, to);
  const double area = glm::length(glm::cross(this->EdgeU_, this->EdgeV_)) /
                      std::abs(glm::dot(this->Plate_.Normal, facet.Normal));
  return std::max(0.0, area * glm::dot(to, facet.Normal) / (square * std::sqrt(square)));
}

void SignLook::FillZones(Part& part) const
{
  part.Zones.resize(1 + *std::max_element(part.ZoneOf.begin(), part.ZoneOf.end()));
  std::vector<double> largest(part.Zones.size(), 0.0);
  for (std::size_t i = 0; i < part.Blocks.size(); ++i)
  {
    const PatternBlock& block = part.Pattern.Blocks()[i];
    const double weight = part.Blocks[i].Density * block.Sum[0];
    Zone& zone = part.Zones[part.ZoneOf[i]];
    zone.Weight += weight;
    zone.Middle += weight * part.Middles[i];
    if (weight > largest[part.ZoneOf[i]])
    {
      largest[part.ZoneOf[i]] = weight;
      zone.Cell = block.Places.front().Cell;
    }
  }
  for (Zone& zone : part.Zones)
  {
    zone.Middle = zone.Weight > 0.0 ? zone.Middle / zone.Weight : zone.Middle;
  }
}

void SignLook::FillFactors(const Facet& facet, Part& part)
{
  std::vector<bool> reflects(part.Zones.size(), false);
  for (std::size_t i = 0; i < part.Blocks.size(); ++i)
  {
    const PatternVector& sum = part.Pattern.Blocks()[i].Sum;
    reflects[part.ZoneOf[i]] =
      reflects[part.ZoneOf[i]] || *std::max_element(sum.begin() + 1 + MaxBands, sum.end()) > 0.0;
  }
  std::vector<Coefficients> factors(part.Zones.size());
  for (std::size_t zone = 0; zone < part.Zones.size(); ++zone)
  {
    if (part.Zones[zone].Weight > 0.0)
    {
      this->FillFactors(facet, part.Zones[zone], reflects[zone], factors[zone]);
    }
  }
  for (std::size_t i = 0; i < part.Blocks.size(); ++i)
  {
    part.Blocks[i].Factors = factors[part.ZoneOf[i]];
  }
}

void SignLook::FillFactors(
  const Facet& facet, const Zone& zone, bool reflects, Coefficients& factors)
{
  const Vec3 point = this->PointOf(facet, zone.Middle);
  const Scene& scene = this->View_.TheScene();
  const Vec3 way = point - this->Eye_;
  const double distance = glm::length(way);
  const Vec3 direction = way / distance;
  const double depth = scene.Smoke().OpticalDepth(this->Eye_, direction, 0.0, distance);
  const std::size_t cell = facet.Cells[zone.Cell];
  const double relative = this->Lights_.CellLaw(facet.Luminous.value_or(cell))
                            .Relative(-direction, -glm::dot(direction, facet.Normal));
  for (int band = 0; band < this->Bands_; ++band)
  {
    const double share = BandWeight(this->View_, band);
    const double bandDepth = scene.ExtinctionScale(band) * depth;
    const double transmitted = share * std::exp(-bandDepth);
    Lanes multiple;
    double steady = 0.0;
    if (reflects)
    {
      const double illuminance = this->View_.Illuminance(
        scene.SurfacePatches() + cell, 0, point, facet.Normal, band, multiple);
      steady = illuminance - Mean(multiple);
    }
    for (int batch = 0; batch < Batches; ++batch)
    {
      factors[batch][1 + band] = transmitted * relative;
      factors[batch][1 + MaxBands + band] =
        transmitted * (steady + multiple[batch]) / glm::pi<double>();
    }
    this->Result_.OpticalDepth += zone.Weight * share * bandDepth;
  }
}

void SignLook::FindVisible(const Facet& facet, const std::vector<double>& shares, Part& part)
{
  for (std::size_t i = 0; i < part.Pattern.Blocks().size(); ++i)
  {
    const PatternBlock& block = part.Pattern.Blocks()[i];
    SeenBlock seen{};
    glm::dvec2 middle(0.0);
    if (!block.Places.empty())
    {
      double area = 0.0;
      for (const PatternPlace& place : block.Places)
      {
        middle += place.Area * place.At;
        area += place.Area;
      }
      middle /= area;
      const double density = this->DensityOf(facet, this->PointOf(facet, middle));
      seen.Density = density * (shares.empty() ? this->VisibleShare(facet, block) : shares[i]);
      this->All_ += density * block.Sum[0];
      this->Seen_ += seen.Density * block.Sum[0];
    }
    part.Blocks.push_back(seen);
    part.Middles.push_back(middle);
  }
}

void SignLook::FillMeans(const std::vector<Part>& parts)
{
  double lit = 0.0;
  double litWeight = 0.0;
  double unlit = 0.0;
  Lanes mean;
  for (const Part& part : parts)
  {
    for (std::size_t i = 0; i < part.Blocks.size(); ++i)
    {
      const SeenBlock& seen = part.Blocks[i];
      const PatternBlock& block = part.Pattern.Blocks()[i];
      const PatternVector factors = MeanFactors(seen.Factors);
      const double litPart = seen.Density * Dot(factors, block.LitSum);
      lit += litPart;
      litWeight += seen.Density * block.LitSum[0];
      unlit += seen.Density * Dot(factors, block.Sum) - litPart;
      for (int batch = 0; batch < Batches; ++batch)
      {
        mean[batch] +=
          static_cast<float>(seen.Density * Dot(seen.Factors[batch], block.Sum) / this->Seen_);
      }
    }
  }
  SignMeasurement& result = this->Result_;
  const double unlitWeight = this->Seen_ - litWeight;
  result.LitLuminance = litWeight > 0.0 ? std::max(0.0, lit / litWeight) : 0.0;
  result.UnlitLuminance =
    unlitWeight > 1e-12 * this->Seen_ ? std::max(0.0, unlit / unlitWeight) : 0.0;
  const double difference = result.LitLuminance - result.UnlitLuminance;
  result.WebberContrast = result.UnlitLuminance > 0.0 ? difference / result.UnlitLuminance : 0.0;
  result.UL924Contrast = result.LitLuminance > 0.0 ? difference / result.LitLuminance : 0.0;
  result.MeanLuminanceError = StandardError(mean);
}

void SignLook::MakeVeils(const std::vector<Facet>& facets, const std::vector<Part>& parts)
{
  std::vector<Vec3> places;
  std::vector<double> weights;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    for (const Zone& zone : parts[i].Zones)
    {
      if (zone.Weight > 0.0)
      {
        places.push_back(this->PointOf(facets[i], zone.Middle));
        weights.push_back(zone.Weight);
      }
    }
  }
  for (int band = 0; band < this->Bands_; ++band)
  {
    if (this->PartlyHidden())
    {
      this->ShownVeils_.emplace_back(this->View_, this->Eye_, band, places, weights);
    }
    else
    {
      this->Veils_.emplace_back(
        this->View_, this->Plate_, this->Eye_, band, this->Across_, this->Up_);
    }
  }
}

void SignLook::AddVeil(std::vector<Part>& parts)
{
  std::size_t place = 0;
  for (Part& part : parts)
  {
    std::vector<DoubleLanes> veils(part.Zones.size());
    for (std::size_t zone = 0; zone < part.Zones.size(); ++zone)
    {
      if (!(part.Zones[zone].Weight > 0.0))
      {
        continue;
      }
      for (int band = 0; band < this->Bands_; ++band)
      {
        const Lanes veil = this->PartlyHidden() ? this->ShownVeils_[band].At(place)
                                                : this->Veils_[band].At(part.Zones[zone].Middle);
        for (int batch = 0; batch < Batches; ++batch)
        {
          veils[zone][batch] += BandWeight(this->View_, band) * veil[batch];
        }
      }
      ++place;
    }
    for (std::size_t i = 0; i < part.Blocks.size(); ++i)
    {
      for (int batch = 0; batch < Batches; ++batch)
      {
        part.Blocks[i].Factors[batch][0] = veils[part.ZoneOf[i]][batch];
      }
    }
  }
}

void SignLook::FillContrast(const std::vector<Part>& parts)
{
  Sums sums;
  for (const Part& part : parts)
  {
    AddPixels(part.Pattern, part.Blocks, sums);
  }
  SignMeasurement& result = this->Result_;
  const ResampledMoments resampled = sums.Get();
  result.MeanLuminance = resampled[0].Mean;
  Jackknife(resampled, 0.0, result.Contrast, result.ContrastError);
  Jackknife(resampled, this->Observer_.DarkLuminance, result.PerceivedContrast,
    result.PerceivedContrastError);
}

void SignLook::FillResult(std::vector<Part>& parts)
{
  this->AddVeil(parts);
  this->FillMeans(parts);
  this->FillContrast(parts);
}

SignMeasurement SignLook::Measure(double cutOff)
{
  const std::vector<Facet> facets = FacetsOf(this->Lights_, this->Plate_, this->Eye_);
  if (facets.empty())
  {
    return {};
  }
  const std::array<int, 2> pixels = this->Pixels();
  const PlateBorders borders = this->Borders();
  std::vector<Part> parts = this->WholeParts(facets, pixels, borders);
  if (pixels[0] == 0 && facets.size() <= MostCutFacets)
  {
    std::vector<PlateLook> looks;
    std::vector<std::vector<glm::dvec2>> odd;
    for (const Facet& facet : facets)
    {
      looks.push_back(LookAt(this->View_, this->Plate_, this->Eye_, facet));
      odd.push_back(OddPlaces(looks.back()));
    }
    if ((this->PartlyHidden() && this->Seen_ > 0.0) ||
        std::any_of(odd.begin(), odd.end(), [](const auto& places) { return !places.empty(); }))
    {
      parts = this->CutParts(facets, looks, odd, borders);
    }
  }
  if (!(this->Seen_ > 0.0))
  {
    return {};
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    this->FillZones(parts[i]);
    this->FillFactors(facets[i], parts[i]);
  }
  SignMeasurement& result = this->Result_;
  result.InView = true;
  if (cutOff > 0.0)
  {
    this->FillContrast(parts);
    if (result.PerceivedContrast < cutOff)
    {
      return {.InView = true, .BelowCutOff = true};
    }
  }
  this->MakeVeils(facets, parts);
  result.VisibleFraction = this->Seen_ / this->All_;
  result.OpticalDepth /= this->Seen_;
  this->FillResult(parts);
  const bool uncertain = result.ContrastError > UncertainContrast;
  const bool lost = std::max(result.LitLuminance, result.UnlitLuminance) <
                    FaintShare * this->Observer_.DarkLuminance;
  if (uncertain && !lost)
  {
    for (int band = 0; band < this->Bands_; ++band)
    {
      result.Rays += this->PartlyHidden()
                       ? this->ShownVeils_[band].Gather(this->View_, this->Eye_, band)
                       : this->Veils_[band].Gather(this->View_, this->Plate_, this->Eye_, band);
    }
    this->FillResult(parts);
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
