#include "SignSight.h"

#include "PolygonLight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace smokevis
{

namespace
{

/// A block over which the optical depth from the eye changes by more than this is halved, so often
/// at most. Where smoke would cut an edge into more blocks than so many, twice the change is
/// allowed, and so on.
constexpr double LargestChange = 0.3;
/// The same where neighbours do not tell how it changes inside a block, since there are too few of
/// them or pixels average them: its middle stands for all of it, to the square of the change over
/// 24 in its mean and over 12 in its mean square.
constexpr double LargestChangeAlone = 0.1;
/// Share of either by which the depth in the middle of a block may be off the mean of those at its
/// ends: there smoke is uneven inside the block.
constexpr double BendShare = 0.1;
/// Shares of the allowed change, and of the allowed bend, up to which no depth is looked at inside
/// a block: of the change from border to border, and of the bend that borders beside tell.
constexpr double ToldChange = 0.25;
constexpr double ToldBend = 0.125;
constexpr std::size_t FewestBlocks = 3;
constexpr int MostHalvings = 5;
constexpr std::size_t MostBlocks = 48;
/// Optical depth, beyond that to the clearest place, from which on nothing is seen beside that.
constexpr double DeepestBlock = 20.0;
/// A plane along an edge rises by no more than this share of it across the plate; and the least
/// width of a block, as a share of the plate's, on either side of such a plane.
constexpr double LevelShare = 1e-6;
constexpr double NarrowestBlock = 1e-6;
/// Where along the other edge the depth is looked at.
constexpr std::array<double, 2> Lines = {0.25, 0.75};
/// Where a plate spans more pixels than this along an edge all of its detail counts as resolved.
constexpr int MostPixels = 512;
/// Signs of more facets are not cut at edges: their facets are small.
constexpr std::size_t MostCutFacets = 8;
/// A block whose diagonal is a smaller share of its distance looks as large as its middle tells, to
/// a thousandth.
constexpr double FarSize = 0.05;

/// Angle that the segment between two points spans at the eye [rad].
double Angle(const Vec3& eye, const Vec3& a, const Vec3& b)
{
  const Vec3 p = a - eye;
  const Vec3 q = b - eye;
  return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
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

/// Middle of what there is of a block.
glm::dvec2 MiddleOf(const PatternBlock& block)
{
  glm::dvec2 middle(0.0);
  double area = 0.0;
  for (const PatternPlace& place : block.Places)
  {
    middle += place.Area * place.At;
    area += place.Area;
  }
  return middle / area;
}

} // namespace

SignSight::SignSight(
  const View& view, const Sign& sign, const Vec3& eye, double acuity, double blocks)
    : View_(view), Lights_(view.TheScene().Lights()), Plate_(sign), Eye_(eye),
      Across_(Lights_, sign, 0), Up_(Lights_, sign, 1), EdgeU_(sign.Corners[1] - sign.Corners[0]),
      EdgeV_(sign.Corners[3] - sign.Corners[0]), Pixels_(this->Pixels(acuity)),
      Fine_(blocks > UsualBlocks), Lit_(LitCells(Lights_, sign))
{
  const std::vector<Facet> facets = FacetsOf(this->Lights_, sign, eye);
  const PlateBorders borders = this->Borders(blocks);
  std::vector<bool> clear;
  std::transform(facets.begin(), facets.end(), std::back_inserter(clear),
    [&](const Facet& facet) { return NothingBefore(view, sign, eye, facet); });
  this->AddWhole(facets, clear, borders);
  this->Clear_ = std::find(clear.begin(), clear.end(), false) == clear.end();
  if (!this->Resolved() || facets.size() > MostCutFacets)
  {
    return;
  }
  std::vector<PlateLook> looks;
  std::vector<std::vector<glm::dvec2>> odd;
  bool hidden = this->PartlyHidden() && this->Seen_ > 0.0;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    looks.push_back(LookAt(view, sign, eye, facets[i]));
    odd.push_back(clear[i] ? std::vector<glm::dvec2>() : OddPlaces(looks.back()));
    hidden = hidden || !odd.back().empty();
  }
  if (hidden)
  {
    this->Parts_.clear();
    this->Places_.clear();
    this->All_ = 0.0;
    this->Seen_ = 0.0;
    this->AddCut(facets, looks, odd, borders);
  }
}

std::array<int, 2> SignSight::Pixels(double acuity) const
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

PlateBorders SignSight::Borders(double blocks) const
{
  const double width = glm::length(this->EdgeU_);
  const double height = glm::length(this->EdgeV_);
  const double largest = std::max(width, height) / blocks;
  const auto bordersAlong = [&](const PlateColumns& columns, double part, int axis)
  { return this->CutBySmoke(this->CutByFaces(BlockBorders(columns, part), axis), axis); };
  return {
    bordersAlong(this->Across_, largest / width, 0), bordersAlong(this->Up_, largest / height, 1)};
}

std::vector<double> SignSight::CutByFaces(std::vector<double> borders, int axis) const
{
  const Vec3& along = axis == 0 ? this->EdgeU_ : this->EdgeV_;
  const Vec3& other = axis == 0 ? this->EdgeV_ : this->EdgeU_;
  for (int normal = 0; normal < 3; ++normal)
  {
    if (std::abs(other[normal]) > LevelShare * glm::length(other) ||
        std::abs(along[normal]) <= LevelShare * glm::length(along) ||
        !this->View_.TheScene().Smoke().FacesAt(normal, this->Eye_[normal]))
    {
      continue;
    }
    const double place = (this->Eye_[normal] - this->Plate_.Corners[0][normal]) / along[normal];
    const auto next = std::lower_bound(borders.begin(), borders.end(), place);
    if (next != borders.begin() && next != borders.end() &&
        std::min(*next - place, place - *(next - 1)) > NarrowestBlock)
    {
      borders.insert(next, place);
    }
  }
  return borders;
}

std::vector<double> SignSight::CutBySmoke(const std::vector<double>& borders, int axis) const
{
  using Depths = std::array<double, Lines.size()>;
  const Scene& scene = this->View_.TheScene();
  const auto depthsAt = [&](double border)
  {
    Depths depths;
    std::transform(Lines.begin(), Lines.end(), depths.begin(),
      [&](double line)
      {
        const Vec3 to =
          OnPlate(this->Plate_, axis == 0 ? border : line, axis == 0 ? line : border) - this->Eye_;
        const double distance = glm::length(to);
        return distance > 0.0 ? scene.LargestScale() * scene.Smoke().OpticalDepth(
                                                         this->Eye_, to / distance, 0.0, distance)
                              : 0.0;
      });
    return depths;
  };
  std::vector<Depths> known(borders.size());
  std::transform(borders.begin(), borders.end(), known.begin(), depthsAt);
  double clearest = std::numeric_limits<double>::infinity();
  for (const Depths& depths : known)
  {
    clearest = std::min(clearest, *std::min_element(depths.begin(), depths.end()));
  }
  // Whether the depths at a block's borders and those beside tell that it holds no more than a
  // small part of what is too much: it need not be looked into.
  const auto tellsEven = [&](std::size_t block, double change)
  {
    const auto width = [&](std::size_t of) { return borders[of + 1] - borders[of]; };
    const auto rise = [&](std::size_t of, std::size_t line)
    { return known[of + 1][line] - known[of][line]; };
    for (std::size_t line = 0; line < Lines.size(); ++line)
    {
      double bend = 0.0;
      for (const std::size_t other : {block - 1, block + 1})
      {
        // The number before the first block's is larger than all.
        if (other < borders.size() - 1)
        {
          const double steeper =
            rise(other, line) / width(other) - rise(block, line) / width(block);
          bend = std::max(bend, std::abs(steeper) * width(block) * width(block) /
                                  (4.0 * (width(block) + width(other))));
        }
      }
      if (std::abs(rise(block, line)) > ToldChange * change || bend > ToldBend * BendShare * change)
      {
        return false;
      }
    }
    return true;
  };
  std::vector<double> cut;
  // Halves what lies between two borders where that is too much, and adds the borders after the
  // first.
  const auto add = [&](const auto& self, double from, const Depths& first, double to,
                     const Depths& last, int halvings, double change) -> void
  {
    const double middle = 0.5 * (from + to);
    const Depths within = halvings > 0 ? depthsAt(middle) : first;
    bool uneven = false;
    for (std::size_t line = 0; line < Lines.size() && halvings > 0; ++line)
    {
      const auto [least, most] = std::minmax({first[line], within[line], last[line]});
      const double bend = std::abs(within[line] - 0.5 * (first[line] + last[line]));
      uneven = uneven || ((most - least > change || bend > BendShare * change) &&
                           least < clearest + DeepestBlock);
    }
    if (!uneven)
    {
      cut.push_back(to);
      return;
    }
    self(self, from, first, middle, within, halvings - 1, change);
    self(self, middle, within, to, last, halvings - 1, change);
  };
  const bool told = this->Resolved() && borders.size() > FewestBlocks;
  // Where smoke was found uneven, or one block has no other beside it, all are looked into.
  const bool coarse = !this->Fine_ && borders.size() > 2;
  for (double change = told ? LargestChange : LargestChangeAlone;
       cut.empty() || cut.size() > MostBlocks + borders.size(); change *= 2.0)
  {
    cut.assign(1, borders[0]);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i)
    {
      add(add, borders[i], known[i], borders[i + 1], known[i + 1],
        coarse && tellsEven(i, change) ? 0 : MostHalvings, change);
    }
  }
  return cut;
}

PlatePattern SignSight::PatternOf(
  const Facet& facet, const PatternAxis& across, const PatternAxis& up) const
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
    for (int band = 0; band < this->Lights_.Bands(); ++band)
    {
      cell.Value[1 + band] = emitter.Luminance[band];
      cell.Value[1 + MaxBands + band] = emitter.Reflectance[band];
    }
    cell.Lit = this->Lit_[index];
    cells.push_back(std::move(cell));
  }
  return {cells, across, up};
}

void SignSight::AddWhole(
  const std::vector<Facet>& facets, const std::vector<bool>& clear, const PlateBorders& borders)
{
  const PatternAxis across(borders[0], this->Pixels_[0]);
  const PatternAxis up(borders[1], this->Pixels_[1]);
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    const Facet& facet = facets[i];
    PlatePattern pattern = this->PatternOf(facet, across, up);
    std::vector<double> shares;
    for (const PatternBlock& block : pattern.Blocks())
    {
      shares.push_back(clear[i] ? 1.0 : this->VisibleShare(facet, block));
    }
    std::vector<std::size_t> zoneOf(pattern.Blocks().size());
    std::iota(zoneOf.begin(), zoneOf.end(), std::size_t{0});
    const PlateBorders blocks = {across.Borders(), up.Borders()};
    this->AddPart(facet, std::move(pattern), blocks, shares, zoneOf, blocks);
  }
}

void SignSight::AddCut(const std::vector<Facet>& facets, const std::vector<PlateLook>& looks,
  const std::vector<std::vector<glm::dvec2>>& odd, const PlateBorders& borders)
{
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    PlateBorders halved = borders;
    HalveAtEdges(halved, odd[i], looks[i]);
    const std::vector<std::size_t> columns = BlocksBefore(borders[0], halved[0]);
    std::vector<std::size_t> zoneOf;
    for (const std::size_t row : BlocksBefore(borders[1], halved[1]))
    {
      for (const std::size_t column : columns)
      {
        zoneOf.push_back(column + row * (borders[0].size() - 1));
      }
    }
    PlatePattern pattern =
      this->PatternOf(facets[i], PatternAxis(halved[0], 0), PatternAxis(halved[1], 0));
    this->AddPart(
      facets[i], std::move(pattern), halved, SeenShares(halved, looks[i]), zoneOf, borders);
  }
}

void SignSight::AddPart(const Facet& facet, PlatePattern pattern, const PlateBorders& blocks,
  const std::vector<double>& shares, const std::vector<std::size_t>& zoneOf,
  const PlateBorders& borders)
{
  const std::size_t columns = borders[0].size() - 1;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  Part part{facet, std::move(pattern), {}, {}, {}};
  std::vector<std::size_t> numbers(1 + *std::max_element(zoneOf.begin(), zoneOf.end()), none);
  std::vector<double> largest;
  for (std::size_t i = 0; i < zoneOf.size(); ++i)
  {
    const PatternBlock& block = part.Pattern.Blocks()[i];
    part.Densities.push_back(0.0);
    part.ZoneOf.push_back(0);
    if (block.Places.empty())
    {
      continue;
    }
    const glm::dvec2 middle = MiddleOf(block);
    const std::size_t column = i % (blocks[0].size() - 1);
    const std::size_t row = i / (blocks[0].size() - 1);
    const double density = this->DensityOf(part.Front, this->PointOf(part.Front, middle)) *
                           this->NearShare(part.Front, {blocks[0][column], blocks[1][row]},
                             {blocks[0][column + 1], blocks[1][row + 1]});
    const double weight = density * shares[i] * block.Sum[0];
    this->All_ += density * block.Sum[0];
    if (!(weight > 0.0))
    {
      continue;
    }
    this->Seen_ += weight;
    part.Densities.back() = density * shares[i];
    std::size_t& number = numbers[zoneOf[i]];
    if (number == none)
    {
      number = part.Zones.size();
      Zone zone{this->Places_.size()};
      zone.At = {zoneOf[i] % columns, zoneOf[i] / columns};
      part.Zones.push_back(zone);
      SeenPlace& added = this->Places_.emplace_back();
      for (int axis = 0; axis < 2; ++axis)
      {
        added.Size[axis] = borders[axis][zone.At[axis] + 1] - borders[axis][zone.At[axis]];
      }
      largest.push_back(0.0);
    }
    part.ZoneOf.back() = number;
    Zone& zone = part.Zones[number];
    SeenPlace& place = this->Places_[zone.Place];
    place.Weight += weight;
    place.OnPlate += weight / place.Weight * (middle - place.OnPlate);
    zone.Reflects =
      zone.Reflects || *std::max_element(block.Sum.begin() + 1 + MaxBands, block.Sum.end()) > 0.0;
    if (weight > largest[number])
    {
      largest[number] = weight;
      zone.Cell = part.Front.Cells[block.Places.front().Cell];
    }
  }
  for (const Zone& zone : part.Zones)
  {
    SeenPlace& place = this->Places_[zone.Place];
    place.Point = this->PointOf(part.Front, place.OnPlate);
  }
  this->Parts_.push_back(std::move(part));
}

double SignSight::VisibleShare(const Facet& facet, const PatternBlock& block) const
{
  double seen = 0.0;
  double all = 0.0;
  for (const PatternPlace& place : block.Places)
  {
    const bool sees = Sees(this->View_, this->Plate_, this->Eye_, this->PointOf(facet, place.At));
    seen += sees ? place.Area : 0.0;
    all += place.Area;
  }
  return all > 0.0 ? seen / all : 0.0;
}

double SignSight::DensityOf(const Facet& facet, const Vec3& point) const
{
  const Vec3 to = this->Eye_ - point;
  const double square = glm::dot(to, to);
  const double area = glm::length(glm::cross(this->EdgeU_, this->EdgeV_)) /
                      std::abs(glm::dot(this->Plate_.Normal, facet.Normal));
  return std::max(0.0, area * glm::dot(to, facet.Normal) / (square * std::sqrt(square)));
}

double SignSight::NearShare(const Facet& facet, const glm::dvec2& low, const glm::dvec2& high) const
{
  const std::array<Vec3, 4> corners = {this->PointOf(facet, low),
    this->PointOf(facet, {high.x, low.y}), this->PointOf(facet, high),
    this->PointOf(facet, {low.x, high.y})};
  const Vec3 middle = this->PointOf(facet, 0.5 * (low + high));
  if (glm::length(corners[2] - corners[0]) < FarSize * glm::length(middle - this->Eye_))
  {
    return 1.0;
  }
  const double told = this->DensityOf(facet, middle) * (high.x - low.x) * (high.y - low.y);
  return told > 0.0 ? SolidAngle(this->Eye_, corners) / told : 1.0;
}

Vec3 SignSight::PointOf(const Facet& facet, const glm::dvec2& place) const
{
  return OnFacet(this->Lights_, this->Plate_, facet, place);
}

} // namespace smokevis
