#include "PlateVeil.h"

#include "GaussNodes.h"
#include <algorithm>
#include <numeric>

namespace smokevis
{

namespace
{

/// Columns of a sign's pattern that are told apart; a finer pattern glows as one.
constexpr std::size_t MostColumns = 16;
/// Errors of sixteen batches are known to a fifth: what is gathered is clearly better where its
/// error is below this share of the other.
constexpr double BetterShare = 0.7;

/// What is gathered over what is known, where it is clearly better; else 0. And the rays that took.
GatheredVeil GatherChange(const View& view, const Vec3& eye, const std::vector<SightLine>& lines,
  const Lanes& known, int band)
{
  GatheredVeil change = view.GatherVeil(eye, lines, band);
  if (StandardError(change.Multiple) < BetterShare * StandardError(known))
  {
    Add(change.Multiple, known, -1.0F);
  }
  else
  {
    change.Multiple = {};
  }
  return change;
}

} // namespace

PlateColumns::PlateColumns(std::vector<double> borders)
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

std::size_t PlateColumns::Of(double t) const
{
  return std::upper_bound(this->Ends.begin() + 1, this->Ends.end() - 1, t) -
         (this->Ends.begin() + 1);
}

double PlateColumns::Node(std::size_t column, int index) const
{
  const double width = this->Ends[column + 1] - this->Ends[column];
  return this->Ends[column] + width * Nodes2[index];
}

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

PlateVeil::PlateVeil(const View& view, const Sign& sign, const Vec3& eye, int band,
  const PlateColumns& columns, const PlateColumns& rows)
    : Columns_(columns), Rows_(rows)
{
  // The pattern blurs over a distance of about its period.
  this->Reach_ = 2.0 * std::min(columns.Widest * glm::length(sign.Corners[1] - sign.Corners[0]),
                         rows.Widest * glm::length(sign.Corners[3] - sign.Corners[0]));
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      this->Far_[j][i] = this->Trace(view, sign, eye, band, Nodes3[i], Nodes3[j], true);
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

Lanes PlateVeil::At(const glm::dvec2& place) const
{
  const auto u = QuadraticWeights(place.x);
  const auto v = QuadraticWeights(place.y);
  Lanes veil =
    this->Near_[this->Rows_.Of(place.y) * this->Columns_.Count() + this->Columns_.Of(place.x)];
  double steady = 0.0;
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double share = u[i] * v[j];
      const RayLight& light = this->Far_[j][i];
      steady += share * light.VeilDirect;
      Add(veil, light.VeilMultiple, static_cast<float>(share));
    }
  }
  for (float& value : veil.Value)
  {
    value += static_cast<float>(steady);
  }
  return veil;
}

std::size_t PlateVeil::Gather(const View& view, const Sign& sign, const Vec3& eye, int band)
{
  std::vector<SightLine> lines;
  Lanes known;
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 to = OnPlate(sign, Nodes3[i], Nodes3[j]) - eye;
      const double distance = glm::length(to);
      const double weight = Weights3[i] * Weights3[j];
      lines.push_back({to / distance, this->FarEnd(distance), weight});
      Add(known, this->Far_[j][i].VeilMultiple, static_cast<float>(weight));
    }
  }
  const GatheredVeil change = GatherChange(view, eye, lines, known, band);
  for (auto& row : this->Far_)
  {
    for (RayLight& light : row)
    {
      Add(light.VeilMultiple, change.Multiple, 1.0F);
    }
  }
  return change.Rays;
}

RayLight PlateVeil::Trace(
  const View& view, const Sign& sign, const Vec3& eye, int band, double u, double v, bool far) const
{
  const Vec3 to = OnPlate(sign, u, v) - eye;
  const double distance = glm::length(to);
  const Vec3 direction = to / distance;
  const double border = this->FarEnd(distance);
  return far ? view.TraceVeil(eye, direction, 0.0, border, band)
             : view.TraceVeil(eye, direction, border, distance, band);
}

ShownVeil::ShownVeil(const View& view, const Vec3& eye, int band, const std::vector<Vec3>& places,
  const std::vector<double>& weights)
{
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t place = 0; place < places.size(); ++place)
  {
    const Vec3 to = places[place] - eye;
    const double distance = glm::length(to);
    this->Lines_.push_back({to / distance, distance, weights[place] / all});
    this->Lights_.push_back(view.TraceVeil(eye, to / distance, 0.0, distance, band));
  }
}

Lanes ShownVeil::At(std::size_t place) const
{
  Lanes veil = this->Lights_[place].VeilMultiple;
  for (float& value : veil.Value)
  {
    value += static_cast<float>(this->Lights_[place].VeilDirect);
  }
  return veil;
}

std::size_t ShownVeil::Gather(const View& view, const Vec3& eye, int band)
{
  Lanes known;
  for (std::size_t i = 0; i < this->Lines_.size(); ++i)
  {
    Add(known, this->Lights_[i].VeilMultiple, static_cast<float>(this->Lines_[i].Weight));
  }
  const GatheredVeil change = GatherChange(view, eye, this->Lines_, known, band);
  for (RayLight& light : this->Lights_)
  {
    Add(light.VeilMultiple, change.Multiple, 1.0F);
  }
  return change.Rays;
}

} // namespace smokevis
