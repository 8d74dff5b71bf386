#include "View.h"

#include "CellLoops.h"
#include "DirectField.h"
#include "MultipleShape.h"
#include "NearMultiple.h"
#include "ShapeNoise.h"
#include "VeilGather.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

namespace
{

/// A line meets a wall in the border of two cells to single precision only, so that cells inside
/// solids see a trace of the light outside: less than this share of the mean fluence.
constexpr double LeakShare = 1e-4;
/// Share of the veil of the smoke ahead, in shares of the light field's tolerance, below which what
/// lies behind is left out.
constexpr double NegligibleShare = 0.01;
/// How many times as much as an evenly bright plate leaves right before it one of a measured law
/// may leave there: light that comes along it goes with the logarithm of the distance.
constexpr double MostOfMeasured = 8.0;

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
  Implementation(const Scene& scene, const LightField& field, const ViewSkips& skips)
      : TheScene(scene), Field(field), Direct(scene), DirectFluence(scene, field)
  {
    for (int band = 0; band < field.Bands && scene.Albedo() > 0.0; ++band)
    {
      const std::vector<float> means = WellKnownMeans(field, band);
      this->MultipleShape[band] = ShapeOfMultiple(scene, band, means);
      this->MultipleNoise[band] = ShapeNoise(scene, band,
        field.MultipleFluence.data() + field.CellIndex(band, 0), means, this->MultipleShape[band]);
      this->Indirect[band] = std::make_unique<IndirectLight>(scene, field, this->DirectFluence,
        this->MultipleShape[band], band, IndirectLight::Reflection::OfPatches);
      this->MultipleNear[band] = std::make_unique<NearMultiple>(*this->Indirect[band]);
    }
    this->FindLeak();
    this->Negligible = skips.HiddenSmoke ? NegligibleShare * field.Tolerance : 0.0;
    for (int band = 0; band < field.Bands; ++band)
    {
      this->Brightest[band] = this->BrightestSmoke(band);
    }
  }

  void FindLeak();
  /// Bound of the luminance that smoke sends out in any direction, were it infinitely thick
  /// [cd/m2].
  double BrightestSmoke(int band) const;
  /// Adds weight times the batches of what multiply scattered light sends out of a piece.
  void AddMultiple(const SmokePiece& piece, int band, double weight, Lanes& sum) const;

  const Scene& TheScene;
  const LightField& Field;
  DirectLight Direct;
  DirectField DirectFluence;
  /// How the multiply scattered fluence varies inside the cells.
  std::array<CellShape, 3> MultipleShape;
  std::array<ShapeNoise, 3> MultipleNoise;
  /// All but direct light along rays, none where nothing scatters; and how it varies inside cells
  /// right beside lights.
  std::array<std::unique_ptr<IndirectLight>, 3> Indirect;
  std::array<std::unique_ptr<NearMultiple>, 3> MultipleNear;
  /// Fluence that rounding may let through the walls of a solid [lx].
  Spectrum Leak{};
  /// What BrightestSmoke tells.
  Spectrum Brightest{};
  /// Share of the veil ahead that counts as nothing.
  double Negligible = 0.0;
  /// In a line of the cache that nothing else is read from.
  alignas(64) std::atomic<std::size_t> CutShort{0};
};

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

double View::Implementation::BrightestSmoke(int band) const
{
  const double albedo = this->TheScene.Albedo();
  double lamp = 0.0;
  const EmitterSet& lights = this->TheScene.Lights();
  for (std::size_t cell = 0; cell < lights.Cells().size(); ++cell)
  {
    // Radiance is nowhere more than the brightest plate's.
    const EmissionLaw& law = lights.CellLaw(cell);
    const double most = law.Measured() ? MostOfMeasured * law.LargestIntensity() : 1.0;
    lamp = std::max(lamp, most * lights.Cells()[cell].Luminance[band]);
  }
  struct Most
  {
    double Fluence = 0.0;
    double Emission = 0.0;
  };
  const Medium& smoke = this->TheScene.Smoke();
  const Most most = ReduceCells(
    this->Field.Cells, Most(),
    [&](Most& value, std::int64_t cell)
    {
      value.Emission = std::max<double>(value.Emission, smoke.EmittedLuminance(cell));
      const double multiple = Mean(this->Field.MultipleFluence[this->Field.CellIndex(band, cell)]);
      const double smooth = this->DirectFluence.SmoothMean(cell, band);
      if (albedo > 0.0 && CellShape::LargestOfAll * (smooth + multiple) > value.Fluence)
      {
        const Box bounds = smoke.CellBounds(cell);
        const double larger = this->MultipleNear[band]->Tells(cell)
                                ? NearMultiple::Largest
                                : this->MultipleShape[band].Largest(cell, bounds);
        value.Fluence = std::max(
          value.Fluence, this->DirectFluence.SmoothMost(cell, bounds, band) + larger * multiple);
      }
    },
    [](const Most& a, const Most& b) {
      return Most{std::max(a.Fluence, b.Fluence), std::max(a.Emission, b.Emission)};
    });
  return albedo * (lamp + most.Fluence / (4.0 * glm::pi<double>())) +
         (1.0 - albedo) * most.Emission;
}

void View::Implementation::AddMultiple(
  const SmokePiece& piece, int band, double weight, Lanes& sum) const
{
  const NearMultiple& near = *this->MultipleNear[band];
  const bool tells = near.Tells(piece.Cell);
  const double there = weight * (tells ? piece.Lost * near.Value(piece.Cell, piece.Middle)
                                       : this->MultipleShape[band].Emerging(piece));
  Add(sum, this->Field.MultipleFluence[this->Field.CellIndex(band, piece.Cell)],
    static_cast<float>(there));
  if (!tells)
  {
    this->MultipleNoise[band].Add(piece.Cell, piece.Middle, there, sum);
  }
}

View::View(std::shared_ptr<const Scene> scene, std::shared_ptr<const LightField> field,
  const ViewSkips& skips)
    : Scene_(std::move(scene)), Field_(std::move(field)), Skips_(skips),
      Implementation_(std::make_unique<Implementation>(*this->Scene_, *this->Field_, skips))
{
}

View::~View() = default;

Hit View::FirstHit(const Vec3& origin, const Vec3& direction, double end) const
{
  return this->Scene_->Shapes().Intersect(origin, direction, 0.0, end);
}

std::size_t View::RaysCutShort() const
{
  return this->Implementation_->CutShort;
}

double View::BrightestSmoke(int band) const
{
  return this->Implementation_->Brightest[band];
}

RayLight View::TraceVeil(
  const Vec3& origin, const Vec3& direction, double begin, double end, int band, double ahead) const
{
  Implementation& self = *this->Implementation_;
  const Medium& smoke = this->Scene_->Smoke();
  const double scale = this->Scene_->ExtinctionScale(band);
  const double albedo = this->Scene_->Albedo();
  const double scatter = albedo / (4.0 * glm::pi<double>());
  RayLight light;
  light.OpticalDepth =
    begin > 0.0 ? scale * smoke.OpticalDepth(origin, direction, 0.0, begin) : 0.0;
  thread_local std::vector<Segment> segments;
  smoke.WalkSmoke(origin, direction, begin, end, segments);
  double passed = std::exp(-light.OpticalDepth);
  const double brightest = self.Brightest[band];
  const double negligible = self.Negligible;
  bool cut = false;
  for (const Segment& segment : segments)
  {
    const double extinction = smoke.Extinction(segment.Cell) * scale;
    const double length = segment.End - segment.Begin;
    const double depth = extinction * length;
    // What is left of the brightest smoke, from here to the end of the ray.
    const bool counts = depth > 0.0 && light.OpticalDepth < DeepestVeil;
    cut = cut || (counts && passed * brightest <
                              negligible * (ahead + light.VeilDirect + Mean(light.VeilMultiple)));
    if (counts && !cut)
    {
      const SmokePiece piece(
        segment.Cell, origin + segment.Begin * direction, length * direction, depth);
      if (albedo > 0.0)
      {
        const double weight = scatter * passed;
        light.VeilDirect += weight * self.DirectFluence.SmoothEmerging(piece, band);
        self.AddMultiple(piece, band, weight, light.VeilMultiple);
        if (self.DirectFluence.Near(segment.Cell))
        {
          light.VeilDirect += passed * self.DirectFluence.NearVeil(segment.Cell, origin, direction,
                                         segment.Begin, segment.End, extinction, band);
        }
      }
      light.VeilDirect +=
        (1.0 - albedo) * passed * piece.Lost * smoke.EmittedLuminance(segment.Cell);
      passed *= piece.Passed;
    }
    light.OpticalDepth += depth;
  }
  if (cut)
  {
    self.CutShort.fetch_add(1, std::memory_order_relaxed);
  }
  return light;
}

GatheredVeil View::GatherVeil(
  const Vec3& origin, const std::vector<SightLine>& lines, int band) const
{
  if (this->Scene_->Albedo() == 0.0)
  {
    return {};
  }
  return smokevis::GatherVeil(*this->Implementation_->Indirect[band], origin, lines);
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

Spectrum View::DirectIlluminance(const Vec3& point, const Vec3& normal) const
{
  Spectrum direct{};
  for (std::size_t light = 0; light < this->Scene_->Lights().Lights().size(); ++light)
  {
    const Spectrum own = this->Implementation_->Direct.Illuminance(light, point, normal);
    std::transform(own.begin(), own.end(), direct.begin(), direct.begin(), std::plus<>());
  }
  return direct;
}

Lanes View::MultipleIlluminance(std::size_t patch, int side, const Vec3& point, int band) const
{
  Lanes lanes = this->Field_->MultipleIlluminance[this->Field_->PatchIndex(band, patch, side)];
  const Vec3 gradient = this->Field_->GradientOn(band, patch);
  if (side == 0 && gradient != Vec3(0.0))
  {
    const Vec3 centre = this->Scene_->Lights().CellCentre(patch - this->Scene_->SurfacePatches());
    const double share = std::max(0.0, 1.0 + glm::dot(gradient, point - centre));
    for (float& value : lanes.Value)
    {
      value *= static_cast<float>(share);
    }
  }
  return lanes;
}

double View::Illuminance(
  std::size_t patch, int side, const Vec3& point, const Vec3& normal, int band, Lanes& lanes) const
{
  lanes = this->MultipleIlluminance(patch, side, point, band);
  return std::max(0.0, this->DirectIlluminance(point, normal)[band] + Mean(lanes));
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
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int z = -1; z <= 1; ++z)
      {
        const int odd = std::abs(x) + std::abs(y) + std::abs(z);
        if (odd == 1 || odd == 3)
        {
          // Slightly askew, so that no ray runs along the edges of the solid.
          directions.push_back(glm::normalize(Vec3(x + 0.0137, y + 0.0071, z - 0.0093)));
        }
      }
    }
  }
  return this->Scene_->Shapes().SeesBacks(point, directions);
}

} // namespace smokevis
