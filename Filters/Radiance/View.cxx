#include "View.h"

#include "DirectLight.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace smokevis
{

namespace
{

/// A light counts as near to a cell within so many cell edges of the cell: the
/// fluence of its light is then too steep to be interpolated between cells.
constexpr double NearEdges = 4.0;
/// Most change of the logarithm of a fluence across a cell.
constexpr double SteepestChange = 4.0;
/// Smoke behind this optical depth adds less than single precision shows.
constexpr double DeepestDepth = 60.0;
/// Parts of a piece of a ray near a light: most, where the smoke is thick; and, where the ray runs
/// into the plate, how many and how much closer to the plate each ends.
constexpr int MostParts = 16;
constexpr int GradedParts = 2;
constexpr double Grading = 0.25;

/// A line meets a wall in the border of two cells to single precision only, so that cells inside
/// solids see a trace of the light outside: less than this share of the mean fluence.
constexpr double LeakShare = 1e-4;

/// Gauss-Legendre nodes and weights on (0, 1).
constexpr std::array<double, 4> GaussNodes = {
  0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
constexpr std::array<double, 4> GaussWeights = {
  0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};

void Add(Lanes& sum, const Lanes& term, float weight)
{
  for (int batch = 0; batch < Batches; ++batch)
  {
    sum.Value[batch] += weight * term.Value[batch];
  }
}

} // namespace

double RayLight::Veil() const
{
  return std::max(0.0, this->VeilDirect + Mean(this->VeilMultiple));
}

double RayLight::Total() const
{
  return std::max(0.0, this->Surface) + this->Veil();
}

Lanes RayLight::TotalLanes() const
{
  Lanes total;
  const double fixed = this->Surface - Mean(this->SurfaceMultiple) + this->VeilDirect;
  for (int batch = 0; batch < Batches; ++batch)
  {
    total[batch] =
      static_cast<float>(fixed) + this->SurfaceMultiple[batch] + this->VeilMultiple[batch];
  }
  return total;
}

/// What views need beyond the light field: how it varies inside and between cells.
struct View::Implementation
{
  /// Near lights of a cell and the direct fluence of all other lights in it.
  struct NearCell
  {
    std::vector<std::uint32_t> Lights;
    /// Which of them the whole cell sees unhidden.
    std::vector<bool> Clear;
    /// Value at the centre [lx] and gradient [lx/m].
    Spectrum Far{};
    std::array<Spectrum, 3> FarGradient{};
  };

  explicit Implementation(const Scene& scene, const LightField& field)
      : TheScene(scene), Field(field), Direct(scene)
  {
    this->MultipleMean.reserve(field.MultipleFluence.size());
    for (const Lanes& lanes : field.MultipleFluence)
    {
      this->MultipleMean.push_back(static_cast<float>(Mean(lanes)));
    }
    this->FindOpenFaces();
    this->FindNearCells();
    this->FindLeak();
  }

  void FindOpenFaces();
  void FindLeak();
  void FindNearCells();
  Spectrum FarFluence(const NearCell& near, const Vec3& point) const;
  /// Direct fluence, of the lights that are not near, at a point of a cell [lx].
  double SmoothDirect(std::int64_t cell, const Vec3& point, int band) const;
  /// Value of a field of cell means at a point of a cell, over its mean there. Light falls off
  /// exponentially in smoke, so its logarithm is taken to vary linearly between neighbours.
  double Shape(const float* means, std::int64_t cell, const Vec3& point) const;
  /// Adds weight times the batches of the fluence at a point of a cell.
  void AddMultiple(std::int64_t cell, const Vec3& point, int band, double weight, Lanes& sum) const;
  /// Light of near lights that a piece of a ray scatters towards its beginning, before what lies
  /// ahead of the piece dims it [cd/m2].
  double NearLight(const NearCell& near, const Vec3& origin, const Vec3& direction, double begin,
    double end, double extinction, int band) const;
  /// Ends of the parts that such a piece is cut into; returns their number.
  static int PartEnds(const LightGroup& light, const Vec3& origin, const Vec3& direction,
    double begin, double end, double extinction, std::array<double, MostParts + 1>& ends);
  const NearCell* Near(std::int64_t cell) const
  {
    const std::int32_t index = this->NearIndex.empty() ? -1 : this->NearIndex[cell];
    return index < 0 ? nullptr : &this->NearCells[index];
  }
  bool Open(std::int64_t cell, int axis, int side) const
  {
    return (this->OpenFaces[cell] >> (2 * axis + side) & 1) != 0;
  }

  const Scene& TheScene;
  const LightField& Field;
  DirectLight Direct;
  /// Bit 2 axis + side is set where light passes freely from a cell's centre to its neighbour's.
  std::vector<unsigned char> OpenFaces;
  /// Mean of the batches of the multiply scattered fluence.
  std::vector<float> MultipleMean;
  std::vector<std::int32_t> NearIndex;
  std::vector<NearCell> NearCells;
  /// Fluence that rounding may let through the walls of a solid [lx].
  Spectrum Leak{};
};

void View::Implementation::FindOpenFaces()
{
  const Medium& smoke = this->TheScene.Smoke();
  const Geometry& shapes = this->TheScene.Shapes();
  this->OpenFaces.assign(smoke.Cells(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, smoke.Cells(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        // Only scattering cells are read by views.
        if (smoke.Extinction(cell) == 0.0F)
        {
          continue;
        }
        const Vec3 centre = smoke.CellCentre(cell);
        for (int axis = 0; axis < 3; ++axis)
        {
          for (int side = 0; side < 2; ++side)
          {
            const std::int64_t other = smoke.Neighbour(cell, axis, side);
            if (other < 0)
            {
              continue;
            }
            Vec3 target = centre;
            target[axis] = smoke.CellCentre(other)[axis];
            const double length = std::abs(target[axis] - centre[axis]);
            if (!shapes.Occluded(centre, (target - centre) / length, 0.0, length))
            {
              this->OpenFaces[cell] |= static_cast<unsigned char>(1 << (2 * axis + side));
            }
          }
        }
      }
    });
}

void View::Implementation::FindLeak()
{
  for (int band = 0; band < this->Field.Bands; ++band)
  {
    double sum = 0.0;
    for (std::size_t cell = 0; cell < this->Field.Cells; ++cell)
    {
      const std::size_t index = this->Field.CellIndex(band, cell);
      sum += this->Field.DirectFluence[index] + Mean(this->Field.MultipleFluence[index]);
    }
    this->Leak[band] = LeakShare * sum / std::max<std::size_t>(1, this->Field.Cells);
  }
}

void View::Implementation::FindNearCells()
{
  const Medium& smoke = this->TheScene.Smoke();
  const EmitterSet& lights = this->TheScene.Lights();
  if (smoke.Empty() || this->TheScene.Albedo() == 0.0)
  {
    return;
  }
  this->NearIndex.assign(smoke.Cells(), -1);
  std::vector<std::vector<std::uint32_t>> nearLights(smoke.Cells());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, smoke.Cells(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        if (smoke.Extinction(cell) == 0.0F)
        {
          continue;
        }
        const Vec3 centre = smoke.CellCentre(cell);
        const Vec3 size = smoke.CellSize(cell);
        const double reach = NearEdges * std::max({size.x, size.y, size.z});
        for (std::size_t light = 0; light < lights.Lights().size(); ++light)
        {
          const LightGroup& root = lights.Groups()[lights.Lights()[light]];
          // Behind a plate there is none of its light.
          if (root.Distance(centre) < reach &&
              glm::dot(centre - root.Centre, root.Normal) > -root.Radius - glm::length(size))
          {
            nearLights[cell].push_back(static_cast<std::uint32_t>(light));
          }
        }
      }
    });
  for (std::size_t cell = 0; cell < smoke.Cells(); ++cell)
  {
    if (!nearLights[cell].empty())
    {
      this->NearIndex[cell] = static_cast<std::int32_t>(this->NearCells.size());
      this->NearCells.push_back({std::move(nearLights[cell]), {}, {}, {}});
    }
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, smoke.Cells(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
      {
        if (this->NearIndex[cell] < 0)
        {
          continue;
        }
        NearCell& near = this->NearCells[this->NearIndex[cell]];
        for (const std::uint32_t light : near.Lights)
        {
          near.Clear.push_back(this->Direct.Clear(light, static_cast<std::int64_t>(cell)));
        }
        if (near.Lights.size() == lights.Lights().size())
        {
          continue;
        }
        const Vec3 centre = smoke.CellCentre(cell);
        const Vec3 size = smoke.CellSize(cell);
        near.Far = this->FarFluence(near, centre);
        for (int axis = 0; axis < 3; ++axis)
        {
          Vec3 moved = centre;
          const double step = 0.25 * size[axis];
          moved[axis] += step;
          const Spectrum value = this->FarFluence(near, moved);
          for (int band = 0; band < this->Field.Bands; ++band)
          {
            near.FarGradient[axis][band] = (value[band] - near.Far[band]) / step;
          }
        }
      }
    });
}

Spectrum View::Implementation::FarFluence(const NearCell& near, const Vec3& point) const
{
  Spectrum sum{};
  std::size_t skip = 0;
  for (std::size_t light = 0; light < this->TheScene.Lights().Lights().size(); ++light)
  {
    if (skip < near.Lights.size() && near.Lights[skip] == light)
    {
      ++skip;
      continue;
    }
    const Spectrum value = this->Direct.Fluence(light, point);
    for (int band = 0; band < this->Field.Bands; ++band)
    {
      sum[band] += value[band];
    }
  }
  return sum;
}

double View::Implementation::SmoothDirect(std::int64_t cell, const Vec3& point, int band) const
{
  if (const NearCell* near = this->Near(cell))
  {
    const Vec3 centre = this->TheScene.Smoke().CellCentre(cell);
    double value = near->Far[band];
    for (int axis = 0; axis < 3; ++axis)
    {
      value += near->FarGradient[axis][band] * (point[axis] - centre[axis]);
    }
    return std::clamp(value, 0.0, 4.0 * near->Far[band]);
  }
  const float* direct = this->Field.DirectFluence.data() + this->Field.CellIndex(band, 0);
  return direct[cell] > 0.0F ? direct[cell] * this->Shape(direct, cell, point) : 0.0;
}

double View::Implementation::Shape(const float* means, std::int64_t cell, const Vec3& point) const
{
  const Medium& smoke = this->TheScene.Smoke();
  const Vec3 centre = smoke.CellCentre(cell);
  const Vec3 size = smoke.CellSize(cell);
  double exponent = 0.0;
  double mean = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<double, 2> value = {means[cell], means[cell]};
    std::array<double, 2> place = {centre[axis], centre[axis]};
    for (int side = 0; side < 2; ++side)
    {
      if (!this->Open(cell, axis, side))
      {
        continue;
      }
      const std::int64_t other = smoke.Neighbour(cell, axis, side);
      if (means[other] > 0.0F)
      {
        value[side] = means[other];
        place[side] = smoke.CellCentre(other)[axis];
      }
    }
    if (place[1] > place[0])
    {
      const double steepest = SteepestChange / size[axis];
      const double slope =
        std::clamp(std::log(value[1] / value[0]) / (place[1] - place[0]), -steepest, steepest);
      exponent += slope * (point[axis] - centre[axis]);
      const double half = 0.5 * slope * size[axis];
      mean *= std::abs(half) < 1e-3 ? 1.0 + half * half / 6.0 : std::sinh(half) / half;
    }
  }
  return std::exp(exponent) / mean;
}

void View::Implementation::AddMultiple(
  std::int64_t cell, const Vec3& point, int band, double weight, Lanes& sum) const
{
  const std::size_t first = this->Field.CellIndex(band, 0);
  const float* means = this->MultipleMean.data() + first;
  const double shape = means[cell] > 0.0F ? this->Shape(means, cell, point) : 1.0;
  Add(sum, this->Field.MultipleFluence[first + cell], static_cast<float>(weight * shape));
}

int View::Implementation::PartEnds(const LightGroup& light, const Vec3& origin,
  const Vec3& direction, double begin, double end, double extinction,
  std::array<double, MostParts + 1>& ends)
{
  ends[0] = begin;
  const double first = glm::dot(origin + begin * direction - light.Centre, light.Normal);
  const double last = glm::dot(origin + end * direction - light.Centre, light.Normal);
  const double close = glm::length(origin + end * direction - light.Centre);
  if (last >= 0.0 && last < 0.3 * first && close < 1.5 * light.Radius)
  {
    // The ray ends close to the plate, where the light follows the pattern: parts shrink towards
    // it.
    int parts = 0;
    for (double height = first; parts + 1 < GradedParts && height * Grading > last;)
    {
      height *= Grading;
      ends[++parts] = begin + (end - begin) * (first - height) / (first - last);
    }
    ends[++parts] = end;
    return parts;
  }
  // The parts are shorter where the smoke is thick.
  const int parts =
    std::clamp(static_cast<int>(std::ceil(extinction * (end - begin))), 1, MostParts);
  for (int part = 1; part <= parts; ++part)
  {
    ends[part] = part == parts ? end : begin + (end - begin) * part / parts;
  }
  return parts;
}

double View::Implementation::NearLight(const NearCell& near, const Vec3& origin,
  const Vec3& direction, double begin, double end, double extinction, int band) const
{
  const EmitterSet& lights = this->TheScene.Lights();
  double sum = 0.0;
  for (std::size_t index = 0; index < near.Lights.size(); ++index)
  {
    const std::uint32_t light = near.Lights[index];
    const LightGroup& root = lights.Groups()[lights.Lights()[light]];
    // Equiangular points about the light follow 1/d^2 (Kulla and Fajardo 2012); a light of some
    // size is no steeper than its radius.
    const double middle = glm::dot(root.Centre - origin, direction);
    const double aside = glm::length(origin + middle * direction - root.Centre);
    const double width = std::max({aside, 0.5 * root.Radius, 1e-9});
    std::array<double, MostParts + 1> ends;
    const int parts = this->PartEnds(root, origin, direction, begin, end, extinction, ends);
    for (int part = 0; part < parts; ++part)
    {
      const double from = ends[part];
      const double to = ends[part + 1];
      const double low = std::atan((from - middle) / width);
      const double high = std::atan((to - middle) / width);
      for (std::size_t i = 0; i < GaussNodes.size(); ++i)
      {
        const double angle = low + (high - low) * GaussNodes[i];
        const double tangent = std::tan(angle);
        const double distance = std::clamp(middle + width * tangent, from, to);
        const double step = GaussWeights[i] * (high - low) * width * (1.0 + tangent * tangent);
        const Spectrum fluence =
          this->Direct.Fluence(light, origin + distance * direction, near.Clear[index]);
        sum += fluence[band] * step * extinction * std::exp(-extinction * (distance - begin));
      }
    }
  }
  return sum * this->TheScene.Albedo() / (4.0 * glm::pi<double>());
}

View::View(std::shared_ptr<const Scene> scene, std::shared_ptr<const LightField> field)
    : Scene_(std::move(scene)), Field_(std::move(field)),
      Implementation_(std::make_unique<Implementation>(*this->Scene_, *this->Field_))
{
}

View::~View() = default;

Hit View::FirstHit(const Vec3& origin, const Vec3& direction, double end) const
{
  return this->Scene_->Shapes().Intersect(origin, direction, 0.0, end);
}

RayLight View::TraceVeil(
  const Vec3& origin, const Vec3& direction, double begin, double end, int band) const
{
  const Implementation& self = *this->Implementation_;
  const Medium& smoke = this->Scene_->Smoke();
  const double scale = this->Scene_->ExtinctionScale(band);
  const double albedo = this->Scene_->Albedo();
  const double scatter = albedo / (4.0 * glm::pi<double>());
  RayLight light;
  light.OpticalDepth =
    begin > 0.0 ? scale * smoke.OpticalDepth(origin, direction, 0.0, begin) : 0.0;
  thread_local std::vector<Segment> segments;
  smoke.Walk(origin, direction, begin, end, segments);
  for (const Segment& segment : segments)
  {
    const double extinction = smoke.Extinction(segment.Cell) * scale;
    const double length = segment.End - segment.Begin;
    const double depth = extinction * length;
    if (depth > 0.0 && light.OpticalDepth < DeepestDepth)
    {
      const double ahead = std::exp(-light.OpticalDepth);
      const double lost = -std::expm1(-depth);
      if (albedo > 0.0)
      {
        // Where a source that varies linearly along the piece takes its mean.
        const double mean = depth < 1e-4 ? 0.5 * length * (1.0 - depth / 6.0)
                                         : 1.0 / extinction - length * (1.0 - lost) / lost;
        const Vec3 point = origin + (segment.Begin + mean) * direction;
        const double weight = scatter * ahead * lost;
        light.VeilDirect += weight * self.SmoothDirect(segment.Cell, point, band);
        self.AddMultiple(segment.Cell, point, band, weight, light.VeilMultiple);
        if (const Implementation::NearCell* near = self.Near(segment.Cell))
        {
          light.VeilDirect += ahead * self.NearLight(*near, origin, direction, segment.Begin,
                                        segment.End, extinction, band);
        }
      }
      light.VeilDirect += (1.0 - albedo) * ahead * lost * smoke.EmittedLuminance(segment.Cell);
    }
    light.OpticalDepth += depth;
  }
  return light;
}

RayLight View::Trace(const Vec3& origin, const Vec3& direction, const Hit& hit, int band) const
{
  RayLight light = this->TraceVeil(origin, direction, 0.0, hit.Distance, band);
  const double transmittance = std::exp(-light.OpticalDepth);
  if (!hit.Found())
  {
    light.Surface = transmittance * this->Scene_->Sky();
    return light;
  }
  const Vec3 point = origin + hit.Distance * direction;
  const std::size_t patch = this->Scene_->Patch(hit);
  if (hit.Emitter)
  {
    light.Surface = transmittance * this->EmitterLuminance(patch - this->Scene_->SurfacePatches(),
                                      hit.Side, point, -direction, band, light.SurfaceMultiple);
  }
  else
  {
    const Vec3 front = this->Scene_->Shapes().Normal(hit);
    light.Surface = transmittance * this->Reflected(patch, hit.Side, point,
                                      hit.Side == 0 ? front : -front, band, light.SurfaceMultiple);
  }
  for (float& value : light.SurfaceMultiple.Value)
  {
    value *= static_cast<float>(transmittance);
  }
  return light;
}

double View::Reflected(
  std::size_t patch, int side, const Vec3& point, const Vec3& normal, int band, Lanes& lanes) const
{
  const double factor = this->Scene_->PatchReflectance(patch)[band] / glm::pi<double>();
  lanes = Lanes();
  if (factor == 0.0)
  {
    return 0.0;
  }
  const double illuminance = this->Illuminance(patch, side, point, normal, band, lanes);
  for (float& value : lanes.Value)
  {
    value *= static_cast<float>(factor);
  }
  return factor * illuminance;
}

double View::Illuminance(std::size_t patch, int side, const Vec3& point, const Vec3& normal,
  int band, Lanes& lanes) const
{
  double direct = 0.0;
  for (std::size_t light = 0; light < this->Scene_->Lights().Lights().size(); ++light)
  {
    direct += this->Implementation_->Direct.Illuminance(light, point, normal)[band];
  }
  lanes = this->Field_->MultipleIlluminance[this->Field_->PatchIndex(band, patch, side)];
  return std::max(0.0, direct + Mean(lanes));
}

double View::EmitterLuminance(std::size_t emitter, int side, const Vec3& point, const Vec3& towards,
  int band, Lanes& lanes) const
{
  const EmitterSet& lights = this->Scene_->Lights();
  const EmitterCell& cell = lights.Cells()[emitter];
  const Vec3 front = lights.CellNormal(emitter);
  double luminance = this->Reflected(
    this->Scene_->SurfacePatches() + emitter, side, point, side == 0 ? front : -front, band, lanes);
  if (side == 0)
  {
    const double cosine = std::max(0.0, glm::dot(towards, front));
    luminance += cell.Luminance[band] * lights.CellLaw(emitter).Relative(towards, cosine);
  }
  return luminance;
}

bool View::InsideSolid(const Vec3& point) const
{
  const Medium& smoke = this->Scene_->Smoke();
  const std::int64_t cell = smoke.Locate(point);
  if (cell >= 0)
  {
    if (smoke.Extinction(cell) > 0.0F)
    {
      return false;
    }
    for (int band = 0; band < this->Field_->Bands; ++band)
    {
      const std::size_t index = this->Field_->CellIndex(band, cell);
      if (this->Field_->DirectFluence[index] + Mean(this->Field_->MultipleFluence[index]) >
          this->Implementation_->Leak[band])
      {
        return false;
      }
    }
  }
  // All faces and corners of a cube around the point: a solid shows its inside everywhere.
  for (int x = -1; x <= 1; ++x)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int z = -1; z <= 1; ++z)
      {
        const int odd = std::abs(x) + std::abs(y) + std::abs(z);
        if (odd != 1 && odd != 3)
        {
          continue;
        }
        // Slightly askew, so that no ray runs along the edges of the solid.
        const Vec3 direction = glm::normalize(Vec3(x + 0.0137, y + 0.0071, z - 0.0093));
        const Hit hit = this->FirstHit(point, direction);
        if (!hit.Found() || hit.Emitter || hit.Side == 0)
        {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace smokevis
