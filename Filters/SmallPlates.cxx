#include "SmallPlates.h"

#include "PolygonClip.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace smokevis
{
namespace
{

/// A plate is small whose narrower side is below so many of the squares that are resolved: samples
/// at the edges would misjudge it by more than a percent.
constexpr double SmallSide = 16.0;
/// Pixels around a plate at most, and the largest square that is resolved, in pixels.
constexpr double MostPixels = 4096.0;
constexpr double LargestSquare = 99.0;
/// Lattice points along the sides of a sign, and of a cell of a lamp.
constexpr int SignPlaces = 8;
constexpr int LampPlaces = 2;
/// Cells of a plane sign lie within this share of its size from one plane.
constexpr double PlaneShare = 1e-3;

/// Weights of the pixels, from the first before to the last behind, that the light of one is spread
/// over.
std::vector<double> SpreadWeights(double resolved)
{
  const int reach = static_cast<int>(std::ceil(0.5 * (resolved - 1.0) - 1e-9));
  std::vector<double> weights(2 * reach + 1, 1.0 / resolved);
  if (reach > 0)
  {
    weights.front() = weights.back() = 0.5 * (1.0 - (2 * reach - 1) / resolved);
  }
  return weights;
}

} // namespace

//------------------------------------------------------------------------------
void SmallPlates::Sums::Add(const Sums& other, double weight)
{
  this->Area += weight * other.Area;
  this->Middle += weight * other.Middle;
  for (int band = 0; band < MaxBands; ++band)
  {
    this->Emitted[band] += weight * other.Emitted[band];
    this->Reflected[band] += weight * other.Reflected[band];
    smokevis::Add(this->Multiple[band], other.Multiple[band], static_cast<float>(weight));
  }
}

//------------------------------------------------------------------------------
SmallPlates::SmallPlates(const View& view, const Camera& camera, double acuity)
    : View_(view), Camera_(camera), Acuity_(acuity), Bands_(view.TheScene().Bands()),
      Small_(view.TheScene().Lights().Cells().size(), 0)
{
  const EmitterSet& lights = view.TheScene().Lights();
  Plate plate;
  for (const Sign& sign : lights.Signs())
  {
    if (this->PlateOf(sign, plate))
    {
      this->AddPlate(plate);
    }
  }
  for (std::size_t cell = 0; cell < lights.Cells().size(); ++cell)
  {
    if (lights.Cells()[cell].SignId < 0 && this->PlateOf(cell, plate))
    {
      this->AddPlate(plate);
    }
  }
}

//------------------------------------------------------------------------------
bool SmallPlates::Covers(const Hit& hit) const
{
  return hit.Found() && hit.Emitter && hit.Side == 0 &&
         this->Small_[this->View_.TheScene().Shapes().Cell(hit)] != 0;
}

//------------------------------------------------------------------------------
double SmallPlates::Share(std::size_t pixel) const
{
  const auto found = this->Shares_.find(pixel);
  double share = 0.0;
  for (std::size_t i = 0; found != this->Shares_.end() && i < found->second.size(); ++i)
  {
    share += found->second[i].Light.Area;
  }
  return std::min(1.0, share);
}

//------------------------------------------------------------------------------
void SmallPlates::Add(std::size_t pixel, PixelSpectrum& light) const
{
  for (const PlateShare& share : this->Shares_.at(pixel))
  {
    const Vec3 way = share.Middle - this->Camera_.Position;
    const double distance = glm::length(way);
    for (int band = 0; band < this->Bands_; ++band)
    {
      const RayLight smoke =
        this->View_.TraceVeil(this->Camera_.Position, way / distance, 0.0, distance, band);
      const double transmitted = std::exp(-smoke.OpticalDepth);
      light[band].Surface +=
        transmitted * (share.Light.Emitted[band] + share.Light.Reflected[band]);
      smokevis::Add(
        light[band].Multiple, share.Light.Multiple[band], static_cast<float>(transmitted));
      light[band].AddVeil(smoke, share.Light.Area);
    }
  }
}

//------------------------------------------------------------------------------
int SmallPlates::SignAt(std::size_t pixel) const
{
  const auto found = this->Middles_.find(pixel);
  return found == this->Middles_.end() ? -1 : found->second;
}

//------------------------------------------------------------------------------
bool SmallPlates::PlateOf(const Sign& sign, Plate& plate) const
{
  const EmitterSet& lights = this->View_.TheScene().Lights();
  const Vec3 across = sign.Corners[1] - sign.Corners[0];
  const Vec3 up = sign.Corners[3] - sign.Corners[0];
  plate = {sign.Cells, sign.Id, sign.Corners[0], glm::normalize(across), glm::normalize(up),
    sign.Normal, glm::length(across), glm::length(up), SignPlaces};
  return glm::dot(this->Camera_.Position - sign.Centre, sign.Normal) > 0.0 &&
         std::all_of(sign.Cells.begin(), sign.Cells.end(),
           [&](std::size_t cell)
           {
             const double off = glm::dot(lights.CellCentre(cell) - plate.Corner, plate.Normal);
             return std::abs(off) <= PlaneShare * sign.Radius &&
                    glm::dot(lights.CellNormal(cell), plate.Normal) > 1.0 - PlaneShare;
           });
}

//------------------------------------------------------------------------------
bool SmallPlates::PlateOf(std::size_t cell, Plate& plate) const
{
  const EmitterSet& lights = this->View_.TheScene().Lights();
  const std::vector<Vec3>& vertices = lights.Cells()[cell].Vertices;
  plate = {{cell}, -1, vertices[0], glm::normalize(vertices[1] - vertices[0]), Vec3(0.0),
    lights.CellNormal(cell), 0.0, 0.0, LampPlaces};
  plate.Up = glm::cross(plate.Normal, plate.Across);
  glm::dvec2 low(0.0);
  glm::dvec2 high(0.0);
  for (const Vec3& vertex : vertices)
  {
    const Vec3 from = vertex - vertices[0];
    const glm::dvec2 place(glm::dot(from, plate.Across), glm::dot(from, plate.Up));
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  plate.Corner += low.x * plate.Across + low.y * plate.Up;
  plate.Width = high.x - low.x;
  plate.Height = high.y - low.y;
  return glm::dot(this->Camera_.Position - plate.Corner, plate.Normal) > 0.0;
}

//------------------------------------------------------------------------------
glm::dvec2 SmallPlates::Project(const Vec3& point) const
{
  const Camera& camera = this->Camera_;
  const Vec3 way = point - camera.Position;
  const double depth = glm::dot(way, camera.Forward);
  return {(glm::dot(way, camera.Right) / depth - camera.Left) / (camera.RightEdge - camera.Left) *
            camera.Width,
    (glm::dot(way, camera.Up) / depth - camera.Bottom) / (camera.Top - camera.Bottom) *
      camera.Height};
}

//------------------------------------------------------------------------------
bool SmallPlates::Frame(const Plate& plate, Window& window, double& resolved) const
{
  const Vec3 across = plate.Width * plate.Across;
  const Vec3 up = plate.Height * plate.Up;
  const Vec3 middle = plate.Corner + 0.5 * (across + up);
  const double distance = glm::distance(middle, this->Camera_.Position);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-low);
  for (const Vec3& corner :
    {plate.Corner, plate.Corner + across, plate.Corner + across + up, plate.Corner + up})
  {
    if (!(glm::dot(corner - this->Camera_.Position, this->Camera_.Forward) > 1e-3 * distance))
    {
      return false;
    }
    low = glm::min(low, this->Project(corner));
    high = glm::max(high, this->Project(corner));
  }
  if (!(high.x > 0.0 && high.y > 0.0 && low.x < this->Camera_.Width &&
        low.y < this->Camera_.Height))
  {
    return false;
  }
  const glm::dvec2 at = this->Project(middle);
  const double step = glm::length(
    this->Camera_.Direction(at.x + 0.5, at.y) - this->Camera_.Direction(at.x - 0.5, at.y));
  resolved = std::max(1.0, this->Acuity_ / std::max(step, 1e-12));
  const glm::dvec2 size = high - low;
  if (resolved > LargestSquare || std::min(size.x, size.y) >= SmallSide * resolved ||
      (size.x + 2.0) * (size.y + 2.0) > MostPixels)
  {
    return false;
  }
  window = {static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)),
    static_cast<int>(std::ceil(high.x)), static_cast<int>(std::ceil(high.y))};
  return window.Columns() > 0 && window.Rows() > 0;
}

//------------------------------------------------------------------------------
std::vector<SmallPlates::Place> SmallPlates::PlacesOn(const Plate& plate) const
{
  const Scene& scene = this->View_.TheScene();
  const std::vector<EmitterCell>& cells = scene.Lights().Cells();
  std::vector<Place> places(plate.Places * plate.Places);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double column = static_cast<double>(i % plate.Places) + 0.5;
    const double row = static_cast<double>(i / plate.Places) + 0.5;
    const Vec3 point = plate.Corner + column / plate.Places * plate.Width * plate.Across +
                       row / plate.Places * plate.Height * plate.Up;
    Place& place = places[i];
    place.Visible = scene.Shapes().Visible(this->Camera_.Position, point);
    for (int band = 0; place.Visible && band < this->Bands_; ++band)
    {
      if (std::any_of(plate.Cells.begin(), plate.Cells.end(),
            [&](std::size_t cell) { return cells[cell].Reflectance[band] > 0.0; }))
      {
        // All cells of a plate share what arrives at it.
        place.Illuminance[band] =
          this->View_.Illuminance(scene.SurfacePatches() + plate.Cells.front(), 0, point,
            plate.Normal, band, place.Multiple[band]);
      }
    }
  }
  return places;
}

//------------------------------------------------------------------------------
void SmallPlates::AddPlate(const Plate& plate)
{
  Window window;
  double resolved = 1.0;
  if (!this->Frame(plate, window, resolved))
  {
    return;
  }
  for (const std::size_t cell : plate.Cells)
  {
    this->Small_[cell] = 1;
  }
  const std::vector<Place> places = this->PlacesOn(plate);
  const Camera& camera = this->Camera_;
  const auto inPicture = [&camera](int column, int row)
  { return column >= 0 && row >= 0 && column < camera.Width && row < camera.Height; };
  const auto index = [&camera](int column, int row)
  { return static_cast<std::size_t>(row) * camera.Width + column; };

  const std::vector<Sums> pixels =
    this->Blurred(this->Draw(plate, places, window), window, resolved);
  for (int row = window.Bottom; row < window.Top; ++row)
  {
    for (int column = window.Left; column < window.Right; ++column)
    {
      const Sums& sums = pixels[(row - window.Bottom) * window.Columns() + column - window.Left];
      if (!(sums.Area > 0.0) || !inPicture(column, row))
      {
        continue;
      }
      const glm::dvec2 at = sums.Middle / sums.Area;
      const Vec3 ray = camera.Direction(at.x, at.y);
      const double distance =
        glm::dot(plate.Corner - camera.Position, plate.Normal) / glm::dot(ray, plate.Normal);
      this->Shares_[index(column, row)].push_back({camera.Position + distance * ray, sums});
    }
  }
  const glm::dvec2 middle =
    this->Project(plate.Corner + 0.5 * (plate.Width * plate.Across + plate.Height * plate.Up));
  const auto column = static_cast<int>(std::floor(middle.x));
  const auto row = static_cast<int>(std::floor(middle.y));
  if (plate.SignId >= 0 && inPicture(column, row) && this->Share(index(column, row)) > 0.0)
  {
    this->Middles_.emplace(index(column, row), plate.SignId);
  }
}

//------------------------------------------------------------------------------
std::vector<SmallPlates::Sums> SmallPlates::Draw(
  const Plate& plate, const std::vector<Place>& places, const Window& window) const
{
  std::vector<Sums> pixels(static_cast<std::size_t>(window.Columns()) * window.Rows());
  for (const std::size_t cell : plate.Cells)
  {
    this->DrawCell(plate, places, cell, window, pixels);
  }
  return pixels;
}

//------------------------------------------------------------------------------
void SmallPlates::DrawCell(const Plate& plate, const std::vector<Place>& places, std::size_t cell,
  const Window& window, std::vector<Sums>& pixels) const
{
  const EmitterSet& lights = this->View_.TheScene().Lights();
  const EmitterCell& emitter = lights.Cells()[cell];
  const Vec3 towards = glm::normalize(this->Camera_.Position - lights.CellCentre(cell));
  const double relative =
    lights.CellLaw(cell).Relative(towards, glm::dot(towards, lights.CellNormal(cell)));
  const auto column = [&plate](const Vec3& point)
  { return glm::dot(point - plate.Corner, plate.Across) / plate.Width * plate.Places; };
  const auto row = [&plate](const Vec3& point)
  { return glm::dot(point - plate.Corner, plate.Up) / plate.Height * plate.Places; };
  // The lattice squares that the cell touches.
  const auto range = [&](const auto& coordinate)
  {
    const auto [low, high] = std::minmax_element(emitter.Vertices.begin(), emitter.Vertices.end(),
      [&](const Vec3& a, const Vec3& b) { return coordinate(a) < coordinate(b); });
    const auto square = [&](const Vec3& point)
    { return std::clamp(static_cast<int>(std::floor(coordinate(point))), 0, plate.Places - 1); };
    return std::pair(square(*low), square(*high));
  };
  const auto [bottom, top] = range(row);
  const auto [left, right] = range(column);
  std::vector<Vec3> strip, piece;
  for (int j = bottom; j <= top; ++j)
  {
    // The outermost take in what rounding leaves over the edge.
    KeepBetween(
      emitter.Vertices, row, j == 0 ? -1.0 : j, j + 1 == plate.Places ? j + 2 : j + 1, strip);
    for (int i = left; strip.size() > 2 && i <= right; ++i)
    {
      const Place& place = places[j * plate.Places + i];
      if (!place.Visible)
      {
        continue;
      }
      KeepBetween(strip, column, i == 0 ? -1.0 : i, i + 1 == plate.Places ? i + 2 : i + 1, piece);
      if (piece.size() < 3)
      {
        continue;
      }
      Sums look;
      for (int band = 0; band < this->Bands_; ++band)
      {
        const double factor = emitter.Reflectance[band] / glm::pi<double>();
        look.Emitted[band] = relative * emitter.Luminance[band];
        look.Reflected[band] = factor * place.Illuminance[band];
        smokevis::Add(look.Multiple[band], place.Multiple[band], static_cast<float>(factor));
      }
      this->DrawPiece(piece, look, window, pixels);
    }
  }
}

//------------------------------------------------------------------------------
void SmallPlates::DrawPiece(const std::vector<Vec3>& piece, const Sums& look, const Window& window,
  std::vector<Sums>& pixels) const
{
  FlatPolygon outline, strip, part;
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-low);
  for (const Vec3& corner : piece)
  {
    outline.push_back(this->Project(corner));
    low = glm::min(low, outline.back());
    high = glm::max(high, outline.back());
  }
  const int top = std::min(window.Top, static_cast<int>(std::ceil(high.y)));
  const int right = std::min(window.Right, static_cast<int>(std::ceil(high.x)));
  for (int row = std::max(window.Bottom, static_cast<int>(std::floor(low.y))); row < top; ++row)
  {
    KeepStrip(outline, 1, row, row + 1, strip);
    for (int column = std::max(window.Left, static_cast<int>(std::floor(low.x))); column < right;
         ++column)
    {
      KeepStrip(strip, 0, column, column + 1, part);
      const double area = AreaOf(part);
      if (area > 0.0)
      {
        Sums& sums = pixels[(row - window.Bottom) * window.Columns() + column - window.Left];
        sums.Add(look, area);
        sums.Area += area;
        sums.Middle += area * MiddleOf(part);
      }
    }
  }
}

//------------------------------------------------------------------------------
std::vector<SmallPlates::Sums> SmallPlates::Blurred(
  const std::vector<Sums>& pixels, Window& window, double resolved) const
{
  const std::vector<double> weights = SpreadWeights(resolved);
  const int reach = static_cast<int>(weights.size()) / 2;
  if (reach == 0)
  {
    return pixels;
  }
  const int columns = window.Columns();
  const int rows = window.Rows();
  const int wide = columns + 2 * reach;
  std::vector<Sums> along(static_cast<std::size_t>(wide) * rows);
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const Sums& from = pixels[row * columns + column];
      for (int i = 0; from.Area > 0.0 && i <= 2 * reach; ++i)
      {
        along[row * wide + column + i].Add(from, weights[i]);
      }
    }
  }
  std::vector<Sums> both(static_cast<std::size_t>(wide) * (rows + 2 * reach));
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < wide; ++column)
    {
      const Sums& from = along[row * wide + column];
      for (int i = 0; from.Area > 0.0 && i <= 2 * reach; ++i)
      {
        both[(row + i) * wide + column].Add(from, weights[i]);
      }
    }
  }
  window = {window.Left - reach, window.Bottom - reach, window.Right + reach, window.Top + reach};
  return both;
}

} // namespace smokevis
