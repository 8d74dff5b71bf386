#include "Contrast.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

namespace
{

/// Samples of the plate along its longer side, at least.
constexpr double SamplesAcross = 8.0;
/// Gauss-Legendre nodes on (0, 1).
constexpr std::array<double, 3> GaussNodes = {0.11270166537925831, 0.5, 0.88729833462074169};
/// Columns of a sign's pattern that are told apart; a finer pattern glows as one.
constexpr std::size_t MostColumns = 16;

/// A piece of the plate as the eye sees it.
struct Sample
{
  /// Solid angle, but for a common factor.
  double Weight;
  /// Index of the pixel of the observer's image that it falls in.
  std::size_t Pixel;
  bool Lit;
  /// Luminance, a value a batch.
  Lanes Light;
};

/// Piece of the plate before its light is known.
struct Piece
{
  std::size_t Cell;
  Vec3 Point;
  double Weight;
  glm::dvec2 Place;
  bool Visible;
};

/// Mean and standard deviation over the pixels of one sign.
struct Moments
{
  double Mean = 0.0;
  double Deviation = 0.0;
};

/// Weights of the quadratic through the three Gauss nodes.
std::array<double, 3> Quadratic(double t)
{
  const double a = GaussNodes[0];
  const double b = GaussNodes[1];
  const double c = GaussNodes[2];
  return {(t - b) * (t - c) / ((a - b) * (a - c)), (t - a) * (t - c) / ((b - a) * (b - c)),
    (t - a) * (t - b) / ((c - a) * (c - b))};
}

/// Columns (or rows) of a sign's pattern along one edge of the plate.
struct Columns
{
  /// Where they begin and end, 0 to 1.
  std::vector<double> Ends;
  double Widest = 1.0;

  explicit Columns(std::vector<double> borders)
  {
    std::sort(borders.begin(), borders.end());
    for (const double border : borders)
    {
      if (this->Ends.empty() || border - this->Ends.back() > 1e-6)
      {
        this->Ends.push_back(border);
      }
    }
    if (this->Ends.size() > MostColumns + 1)
    {
      this->Ends = {0.0, 1.0};
    }
    this->Widest = 0.0;
    for (std::size_t i = 1; i < this->Ends.size(); ++i)
    {
      this->Widest = std::max(this->Widest, this->Ends[i] - this->Ends[i - 1]);
    }
  }

  std::size_t Count() const { return this->Ends.size() - 1; }
  std::size_t Of(double t) const
  {
    return std::upper_bound(this->Ends.begin() + 1, this->Ends.end() - 1, t) -
           (this->Ends.begin() + 1);
  }
  /// The two Gauss points of a column.
  double Node(std::size_t column, int index) const
  {
    const double width = this->Ends[column + 1] - this->Ends[column];
    return this->Ends[column] + width * (index == 0 ? 0.21132486540518712 : 0.78867513459481288);
  }
};

Vec3 OnPlate(const Sign& sign, double u, double v)
{
  return sign.Corners[0] + u * (sign.Corners[1] - sign.Corners[0]) +
         v * (sign.Corners[3] - sign.Corners[0]);
}

glm::dvec2 PlaceOnPlate(const Sign& sign, const Vec3& point)
{
  const Vec3 u = sign.Corners[1] - sign.Corners[0];
  const Vec3 v = sign.Corners[3] - sign.Corners[0];
  const Vec3 from = point - sign.Corners[0];
  return {glm::dot(from, u) / glm::dot(u, u), glm::dot(from, v) / glm::dot(v, v)};
}

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

/// Veil over the plate, in one band. Far from the plate the smoke's light varies
/// slowly over it and is interpolated between three by three rays. Close to the plate the smoke
/// glows in the pattern's shape, so that each column and row of it gets rays of its own.
class PlateField
{
public:
  PlateField(const View& view, const Sign& sign, const Vec3& eye, int band, const Columns& columns,
    const Columns& rows)
      : Columns_(columns), Rows_(rows)
  {
    // The pattern blurs over a distance of about its period.
    this->Reach_ = 2.0 * std::min(columns.Widest * glm::length(sign.Corners[1] - sign.Corners[0]),
                           rows.Widest * glm::length(sign.Corners[3] - sign.Corners[0]));
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        this->Far_[j][i] = this->Trace(view, sign, eye, band, GaussNodes[i], GaussNodes[j], true);
      }
    }
    this->Near_.resize(columns.Count() * rows.Count());
    for (std::size_t row = 0; row < rows.Count(); ++row)
    {
      for (std::size_t column = 0; column < columns.Count(); ++column)
      {
        Lanes& mean = this->Near_[row * columns.Count() + column];
        for (const int j : {0, 1})
        {
          for (const int i : {0, 1})
          {
            const RayLight light =
              this->Trace(view, sign, eye, band, columns.Node(column, i), rows.Node(row, j), false);
            for (int batch = 0; batch < Batches; ++batch)
            {
              mean[batch] +=
                0.25F * (static_cast<float>(light.VeilDirect) + light.VeilMultiple[batch]);
            }
          }
        }
      }
    }
  }

  /// Adds weight times the veil at a place to the batches.
  void Add(const glm::dvec2& place, double weight, Lanes& veil) const
  {
    const auto u = Quadratic(place.x);
    const auto v = Quadratic(place.y);
    const Lanes& near =
      this->Near_[this->Rows_.Of(place.y) * this->Columns_.Count() + this->Columns_.Of(place.x)];
    double steady = 0.0;
    Lanes far;
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        const double share = u[i] * v[j];
        const RayLight& light = this->Far_[j][i];
        steady += share * light.VeilDirect;
        for (int batch = 0; batch < Batches; ++batch)
        {
          far[batch] += static_cast<float>(share) * light.VeilMultiple[batch];
        }
      }
    }
    for (int batch = 0; batch < Batches; ++batch)
    {
      veil[batch] +=
        static_cast<float>(weight) * (static_cast<float>(steady) + far[batch] + near[batch]);
    }
  }

private:
  /// Light of the smoke on the way to a place on the plate: of all but the end of the way, or of
  /// that.
  RayLight Trace(const View& view, const Sign& sign, const Vec3& eye, int band, double u, double v,
    bool far) const
  {
    const Vec3 to = OnPlate(sign, u, v) - eye;
    const double distance = glm::length(to);
    const Vec3 direction = to / distance;
    const double border = std::max(0.0, distance - this->Reach_);
    return far ? view.TraceVeil(eye, direction, 0.0, border, band)
               : view.TraceVeil(eye, direction, border, distance, band);
  }

  const Columns& Columns_;
  const Columns& Rows_;
  double Reach_ = 0.0;
  std::array<std::array<RayLight, 3>, 3> Far_;
  /// Mean over each column of each row.
  std::vector<Lanes> Near_;
};

/// Whether the straight way from the eye ends on that cell's front.
bool Sees(const View& view, const Vec3& eye, const Vec3& point, std::size_t cell)
{
  const Vec3 to = point - eye;
  const double distance = glm::length(to);
  const Geometry& shapes = view.TheScene().Shapes();
  const Hit hit =
    view.FirstHit(eye, to / distance, distance + 20.0 * shapes.Tolerance() + 1e-5 * distance);
  if (!hit.Found() || !hit.Emitter || hit.Side != 0)
  {
    return false;
  }
  // On the seam between two cells of a sign either may be hit.
  const std::vector<EmitterCell>& cells = view.TheScene().Lights().Cells();
  return cells[shapes.Cell(hit)].SignId == cells[cell].SignId;
}

/// Cuts the front cells of a sign into pieces small against plate and pixels.
std::vector<Piece> CutPlate(const View& view, const Sign& sign, const Vec3& eye, double largest)
{
  const EmitterSet& lights = view.TheScene().Lights();
  std::vector<Piece> pieces;
  for (const std::size_t cell : sign.Cells)
  {
    const Vec3& normal = lights.CellNormal(cell);
    const std::vector<Vec3>& vertices = lights.Cells()[cell].Vertices;
    if (glm::dot(eye - vertices[0], normal) <= 0.0)
    {
      continue;
    }
    // A triangle is a quadrilateral with its last corner repeated; more corners are fanned.
    for (std::size_t v = 1; v + 1 < vertices.size(); v += 2)
    {
      const Vec3& a = vertices[0];
      const Vec3& b = vertices[v];
      const Vec3& c = vertices[v + 1];
      const Vec3& d = v + 2 < vertices.size() ? vertices[v + 2] : c;
      const double width = std::max(glm::length(b - a), glm::length(c - d));
      const double height = std::max(glm::length(d - a), glm::length(c - b));
      const int across = std::clamp(static_cast<int>(std::ceil(width / largest - 1e-9)), 1, 64);
      const int up = std::clamp(static_cast<int>(std::ceil(height / largest - 1e-9)), 1, 64);
      for (int j = 0; j < up; ++j)
      {
        for (int i = 0; i < across; ++i)
        {
          const double s = (i + 0.5) / across;
          const double t = (j + 0.5) / up;
          const Vec3 point = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * d + s * c);
          const Vec3 ds = (1.0 - t) * (b - a) + t * (c - d);
          const Vec3 dt = (1.0 - s) * (d - a) + s * (c - b);
          const double area = glm::length(glm::cross(ds, dt)) / (across * up);
          const Vec3 to = eye - point;
          const double square = glm::dot(to, to);
          const double solid = area * glm::dot(to, normal) / (square * std::sqrt(square));
          if (solid > 0.0)
          {
            pieces.push_back(
              {cell, point, solid, PlaceOnPlate(sign, point), Sees(view, eye, point, cell)});
          }
        }
      }
    }
  }
  return pieces;
}

/// Whether a cell counts as lit: brighter, by itself, than half the brightest of its sign. A sign
/// that only reflects is judged by its reflectance.
std::vector<bool> LitCells(const View& view, const Sign& sign)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const int bands = view.TheScene().Bands();
  std::vector<double> brightness(lights.Cells().size(), 0.0);
  double brightest = 0.0;
  double darkest = 1e300;
  for (const bool reflecting : {false, true})
  {
    for (const std::size_t cell : sign.Cells)
    {
      const EmitterCell& emitter = lights.Cells()[cell];
      brightness[cell] = Luminance(reflecting ? emitter.Reflectance : emitter.Luminance, bands);
      brightest = std::max(brightest, brightness[cell]);
      darkest = std::min(darkest, brightness[cell]);
    }
    if (brightest > 0.0)
    {
      break;
    }
    darkest = 1e300;
  }
  std::vector<bool> lit(lights.Cells().size(), false);
  for (const std::size_t cell : sign.Cells)
  {
    lit[cell] = brightness[cell] > 0.5 * (brightest + darkest);
  }
  return lit;
}

Moments MomentsOf(const std::vector<double>& weights, const std::vector<Lanes>& pixels, int leftOut)
{
  // Mean of all batches, or of all but one.
  double weight = 0.0;
  double first = 0.0;
  std::vector<double> values(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    double value = Mean(pixels[i]);
    if (leftOut >= 0)
    {
      value = (Batches * value - pixels[i][leftOut]) / (Batches - 1.0);
    }
    values[i] = std::max(0.0, value);
    weight += weights[i];
    first += weights[i] * values[i];
  }
  Moments moments;
  moments.Mean = first / weight;
  double second = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    second += weights[i] * (values[i] - moments.Mean) * (values[i] - moments.Mean);
  }
  moments.Deviation = std::sqrt(second / weight);
  return moments;
}

/// A ratio of the moments with its jackknife estimate, free of first-order bias, and standard
/// error.
void Jackknife(const Moments& whole, const std::array<Moments, Batches>& parts, double dark,
  double& value, double& error)
{
  const auto ratio = [dark](const Moments& moments)
  {
    const double below = moments.Mean + dark;
    return below > 0.0 ? moments.Deviation / below : 0.0;
  };
  double sum = 0.0;
  double squares = 0.0;
  for (const Moments& part : parts)
  {
    sum += ratio(part);
  }
  const double mean = sum / Batches;
  for (const Moments& part : parts)
  {
    squares += (ratio(part) - mean) * (ratio(part) - mean);
  }
  value = std::max(0.0, Batches * ratio(whole) - (Batches - 1.0) * mean);
  error = std::sqrt((Batches - 1.0) / Batches * squares);
}

} // namespace

SignMeasurement MeasureSign(
  const View& view, std::size_t sign, const Vec3& eye, const Observer& observer)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const Sign& plate = lights.Signs()[sign];
  SignMeasurement result;
  // Pixels of the observer's image across the plate.
  const double wide = Angle(eye, OnPlate(plate, 0.0, 0.5), OnPlate(plate, 1.0, 0.5));
  const double high = Angle(eye, OnPlate(plate, 0.5, 0.0), OnPlate(plate, 0.5, 1.0));
  const double width = glm::length(plate.Corners[1] - plate.Corners[0]);
  const double height = glm::length(plate.Corners[3] - plate.Corners[0]);
  double largest = std::max(width, height) / SamplesAcross;
  double narrowest = 1e300;
  for (const std::size_t cell : plate.Cells)
  {
    const std::vector<Vec3>& vertices = lights.Cells()[cell].Vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      narrowest = std::min(narrowest, Angle(eye, vertices[i], vertices[(i + 1) % vertices.size()]));
    }
  }
  // Detail that the observer resolves stays apart; where some is finer, pixels of the acuity's size
  // average what falls in them.
  const bool resolved = !(narrowest < observer.Acuity);
  int columns = 1;
  int rows = 1;
  if (!resolved)
  {
    columns = std::clamp(static_cast<int>(wide / observer.Acuity), 1, 4096);
    rows = std::clamp(static_cast<int>(high / observer.Acuity), 1, 4096);
    largest = std::min(largest, std::max(width / columns, height / rows) / 2.0);
  }

  const std::vector<Piece> pieces = CutPlate(view, plate, eye, largest);
  double all = 0.0;
  double seen = 0.0;
  for (const Piece& piece : pieces)
  {
    all += piece.Weight;
    seen += piece.Visible ? piece.Weight : 0.0;
  }
  if (!(seen > 0.0))
  {
    return result;
  }
  result.InView = true;
  result.VisibleFraction = seen / all;

  std::vector<double> bordersU;
  std::vector<double> bordersV;
  for (const std::size_t cell : plate.Cells)
  {
    for (const Vec3& vertex : lights.Cells()[cell].Vertices)
    {
      const glm::dvec2 place = PlaceOnPlate(plate, vertex);
      bordersU.push_back(place.x);
      bordersV.push_back(place.y);
    }
  }
  const Columns across(std::move(bordersU));
  const Columns up(std::move(bordersV));
  const int bands = view.TheScene().Bands();
  const std::vector<bool> lit = LitCells(view, plate);
  std::vector<Sample> samples;
  for (int band = 0; band < bands; ++band)
  {
    const PlateField field(view, plate, eye, band, across, up);
    std::size_t index = 0;
    for (const Piece& piece : pieces)
    {
      if (!piece.Visible)
      {
        continue;
      }
      if (band == 0)
      {
        const auto column = std::clamp(static_cast<int>(piece.Place.x * columns), 0, columns - 1);
        const auto row = std::clamp(static_cast<int>(piece.Place.y * rows), 0, rows - 1);
        const std::size_t pixel =
          resolved ? index
                   : static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
        samples.push_back({piece.Weight, pixel, lit[piece.Cell], Lanes()});
      }
      Sample& sample = samples[index++];
      const double weight = BandWeight(view, band);
      field.Add(piece.Place, weight, sample.Light);
      const Vec3 way = piece.Point - eye;
      const double distance = glm::length(way);
      const double depth = view.TheScene().ExtinctionScale(band) *
                           view.TheScene().Smoke().OpticalDepth(eye, way / distance, 0.0, distance);
      Lanes reflected;
      const Vec3 towards = glm::normalize(eye - piece.Point);
      const double luminance =
        view.EmitterLuminance(piece.Cell, 0, piece.Point, towards, band, reflected);
      const double transmitted = weight * std::exp(-depth);
      const double steady = transmitted * (luminance - Mean(reflected));
      for (int batch = 0; batch < Batches; ++batch)
      {
        sample.Light[batch] += static_cast<float>(steady + transmitted * reflected[batch]);
      }
      result.OpticalDepth += piece.Weight / seen * weight * depth;
    }
  }

  // Pixels of the observer's image.
  std::sort(samples.begin(), samples.end(),
    [](const Sample& a, const Sample& b) { return a.Pixel < b.Pixel; });
  std::vector<double> weights;
  std::vector<Lanes> pixels;
  Lanes mean;
  Lanes litMean;
  double litWeight = 0.0;
  for (std::size_t begin = 0; begin < samples.size();)
  {
    std::size_t end = begin;
    double weight = 0.0;
    Lanes sum;
    for (; end < samples.size() && samples[end].Pixel == samples[begin].Pixel; ++end)
    {
      const Sample& sample = samples[end];
      const auto share = static_cast<float>(sample.Weight);
      weight += sample.Weight;
      litWeight += sample.Lit ? sample.Weight : 0.0;
      for (int batch = 0; batch < Batches; ++batch)
      {
        sum[batch] += share * sample.Light[batch];
        litMean[batch] += sample.Lit ? share * sample.Light[batch] : 0.0F;
      }
    }
    for (int batch = 0; batch < Batches; ++batch)
    {
      mean[batch] += sum[batch];
      sum[batch] /= static_cast<float>(weight);
    }
    weights.push_back(weight);
    pixels.push_back(sum);
    begin = end;
  }
  const double litSum = Mean(litMean);
  const double sum = Mean(mean);
  result.LitLuminance = litWeight > 0.0 ? std::max(0.0, litSum / litWeight) : 0.0;
  result.UnlitLuminance =
    seen > litWeight * (1.0 + 1e-12) ? std::max(0.0, (sum - litSum) / (seen - litWeight)) : 0.0;
  const double difference = result.LitLuminance - result.UnlitLuminance;
  result.WebberContrast = result.UnlitLuminance > 0.0 ? difference / result.UnlitLuminance : 0.0;
  result.UL924Contrast = result.LitLuminance > 0.0 ? difference / result.LitLuminance : 0.0;
  result.MeanLuminanceError = StandardError(mean) / seen;

  const Moments whole = MomentsOf(weights, pixels, -1);
  std::array<Moments, Batches> parts;
  for (int batch = 0; batch < Batches; ++batch)
  {
    parts[batch] = MomentsOf(weights, pixels, batch);
  }
  result.MeanLuminance = whole.Mean;
  Jackknife(whole, parts, 0.0, result.Contrast, result.ContrastError);
  Jackknife(
    whole, parts, observer.DarkLuminance, result.PerceivedContrast, result.PerceivedContrastError);
  return result;
}

double PerceivedContrastBound(
  const View& view, std::size_t sign, const Vec3& eye, const Observer& observer)
{
  const EmitterSet& lights = view.TheScene().Lights();
  const Sign& plate = lights.Signs()[sign];
  const int bands = view.TheScene().Bands();
  double luminance = 0.0;
  for (const std::size_t cell : plate.Cells)
  {
    if (glm::dot(eye - lights.CellCentre(cell), lights.CellNormal(cell)) <= 0.0)
    {
      continue;
    }
    Spectrum value{};
    for (int band = 0; band < bands; ++band)
    {
      const std::size_t side =
        view.Field().PatchIndex(band, view.TheScene().SurfacePatches() + cell, 0);
      value[band] = lights.Cells()[cell].Luminance[band] +
                    lights.Cells()[cell].Reflectance[band] / 3.141592653589793 *
                      std::max(0.0, view.Field().DirectIlluminance[side] +
                                      Mean(view.Field().MultipleIlluminance[side]));
    }
    luminance = std::max(luminance, Luminance(value, bands));
  }
  double least = 1e300;
  for (const double u : GaussNodes)
  {
    for (const double v : GaussNodes)
    {
      const Vec3 to = OnPlate(plate, u, v) - eye;
      const double distance = glm::length(to);
      least =
        std::min(least, view.TheScene().Smoke().OpticalDepth(eye, to / distance, 0.0, distance));
    }
  }
  double scale = view.TheScene().ExtinctionScale(0);
  for (int band = 1; band < bands; ++band)
  {
    scale = std::min(scale, view.TheScene().ExtinctionScale(band));
  }
  luminance *= std::exp(-scale * least);
  // Luminances between 0 and M, a share p of them at M, deviate most from their mean for the p that
  // maximises sqrt(p (1 - p)) M / (p M + dark): p = 1 / (M / dark + 2).
  if (luminance == 0.0)
  {
    return 0.0;
  }
  const double ratio = luminance / observer.DarkLuminance;
  return 0.5 * ratio / std::sqrt(ratio + 1.0);
}

} // namespace smokevis
