#include "SignVeil.h"

#include "GaussNodes.h"

#include <numeric>

namespace smokevis
{

namespace
{

/// Errors of sixteen batches are known to a fifth: what is gathered is clearly better where its
/// error is below this share of the other.
constexpr double BetterShare = 0.7;
/// Cosine of the slant beyond which the way of an eye's rays close to a plate gets no longer.
constexpr double LeastSlant = 0.2;
/// Optical depth of scattering on that way below which a few bars of more than so many tell how the
/// glow before them falls off along all: it adds a few hundredths of their luminance there.
constexpr double FaintDepth = 0.1;
constexpr std::size_t FewBars = 3;

} // namespace

std::size_t SignVeil::Gather()
{
  std::vector<SightLine> lines;
  Lanes known;
  for (const Way& way : this->Ways_)
  {
    lines.push_back(way.Line);
    Add(known, way.Light.VeilMultiple, static_cast<float>(way.Line.Weight));
  }
  const GatheredVeil gathered = this->View_.GatherVeil(this->Eye_, lines, this->Band_);
  if (StandardError(gathered.Multiple) < BetterShare * StandardError(known))
  {
    for (Way& way : this->Ways_)
    {
      Add(way.Light.VeilMultiple, gathered.Multiple, 1.0F);
      Add(way.Light.VeilMultiple, known, -1.0F);
    }
  }
  return gathered.Rays;
}

PlateVeil::PlateVeil(const View& view, const Vec3& eye, int band,
  const std::vector<SeenPlace>& places, const Sign& sign, const PlateColumns& columns,
  const PlateColumns& rows)
    : SignVeil(view, eye, band, places), Columns_(columns), Rows_(rows)
{
  const Scene& scene = view.TheScene();
  // The pattern blurs over a distance of about its period, on a slant as far from the plate.
  const double slant =
    std::abs(glm::dot(glm::normalize(eye - OnPlate(sign, 0.5, 0.5)), sign.Normal));
  const double reach = 2.0 *
                       std::min(columns.Widest * glm::length(sign.Corners[1] - sign.Corners[0]),
                         rows.Widest * glm::length(sign.Corners[3] - sign.Corners[0])) /
                       std::max(LeastSlant, slant);
  double nearDepth = 0.0;
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 to = OnPlate(sign, Nodes3[i], Nodes3[j]) - eye;
      const double distance = glm::length(to);
      const double end = std::max(0.0, distance - reach);
      nearDepth =
        std::max(nearDepth, scene.Smoke().OpticalDepth(eye, to / distance, end, distance));
      this->Ways_.push_back(
        {{to / distance, end, Weights3[i] * Weights3[j]}, this->Trace(to / distance, 0.0, end)});
    }
  }
  const auto near = [&](double u, double v)
  {
    const Vec3 to = OnPlate(sign, u, v) - eye;
    const double distance = glm::length(to);
    const RayLight light = this->Trace(to / distance, std::max(0.0, distance - reach), distance);
    Lanes veil = light.VeilMultiple;
    for (float& value : veil.Value)
    {
      value += static_cast<float>(light.VeilDirect);
    }
    return veil;
  };
  const bool bars = rows.Count() == 1 || columns.Count() == 1;
  const PlateColumns& across = rows.Count() == 1 ? columns : rows;
  if (bars && across.Count() > FewBars &&
      scene.Albedo() * scene.ExtinctionScale(band) * nearDepth < FaintDepth)
  {
    this->FillBars(across, [&](double bar, double along)
      { return &across == &columns ? near(bar, along) : near(along, bar); });
    return;
  }
  this->Near_.resize(columns.Count() * rows.Count());
  for (std::size_t row = 0; row < rows.Count(); ++row)
  {
    for (std::size_t column = 0; column < columns.Count(); ++column)
    {
      for (const int j : {0, 1})
      {
        for (const int i : {0, 1})
        {
          Add(this->Near_[row * columns.Count() + column],
            near(columns.Node(column, i), rows.Node(row, j)), 0.25F);
        }
      }
    }
  }
}

void PlateVeil::FillBars(
  const PlateColumns& bars, const std::function<Lanes(double across, double along)>& near)
{
  const std::size_t count = bars.Count();
  this->Near_.resize(count);
  std::vector<double> first(count);
  for (std::size_t bar = 0; bar < count; ++bar)
  {
    const Lanes one = near(bars.Node(bar, 0), 0.5);
    first[bar] = Mean(one);
    Add(this->Near_[bar], one, 0.5F);
    Add(this->Near_[bar], near(bars.Node(bar, 1), 0.5), 0.5F);
  }
  double middle = 0.0;
  double whole = 0.0;
  for (const std::size_t bar : {std::size_t{0}, count / 2, count - 2})
  {
    middle += first[bar];
    for (const double along : Nodes2)
    {
      whole += 0.5 * Mean(near(bars.Node(bar, 0), along));
    }
  }
  const double share = middle > 0.0 ? whole / middle : 1.0;
  for (Lanes& mean : this->Near_)
  {
    for (float& value : mean.Value)
    {
      value *= static_cast<float>(share);
    }
  }
}

Lanes PlateVeil::At(std::size_t place) const
{
  const glm::dvec2& at = this->Places_[place].OnPlate;
  const auto u = QuadraticWeights(at.x);
  const auto v = QuadraticWeights(at.y);
  Lanes veil = this->Near_[this->Rows_.Of(at.y) * this->Columns_.Count() + this->Columns_.Of(at.x)];
  double steady = 0.0;
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double share = u[i] * v[j];
      const RayLight& light = this->Ways_[3 * j + i].Light;
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

ShownVeil::ShownVeil(
  const View& view, const Vec3& eye, int band, const std::vector<SeenPlace>& places)
    : SignVeil(view, eye, band, places)
{
  const double all = std::accumulate(places.begin(), places.end(), 0.0,
    [](double sum, const SeenPlace& place) { return sum + place.Weight; });
  for (const SeenPlace& place : places)
  {
    const Vec3 to = place.Point - eye;
    const double distance = glm::length(to);
    this->Ways_.push_back(
      {{to / distance, distance, place.Weight / all}, this->Trace(to / distance, 0.0, distance)});
  }
}

Lanes ShownVeil::At(std::size_t place) const
{
  const RayLight& light = this->Ways_[place].Light;
  Lanes veil = light.VeilMultiple;
  for (float& value : veil.Value)
  {
    value += static_cast<float>(light.VeilDirect);
  }
  return veil;
}

} // namespace smokevis
