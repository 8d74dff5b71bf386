#include "DirectSolve.h"

#include "CellsAround.h"
#include "ClearBorders.h"
#include "DirectBalance.h"
#include "DirectLight.h"
#include "NearLights.h"
#include "PlateCovers.h"
#include "ReportedLoop.h"
#include "Scene.h"
#include "Team.h"

#include <algorithm>
#include <functional>

#include <tbb/combinable.h>

namespace smokevis
{

namespace
{

/// Cells along the edges of the blocks that share ways to the lights.
constexpr int BlockEdge = 8;
/// Shares of the work that are expected to be done after the cells that plates touch, after others
/// near to lights, after the parts of cells, and after all cells.
constexpr double DepositShare = 0.1;
constexpr double NearShare = 0.2;
constexpr double PartShare = 0.4;
constexpr double CellShare = 0.8;

} // namespace

DirectSolve::DirectSolve(const Scene& scene, const LightFieldOptions& options, Team& team,
  Progress& progress, tbb::task_arena& arena, double share, LightField& field)
    : Scene_(scene), Options_(options), Team_(team), Progress_(progress), Arena_(arena),
      Share_(share), Field_(field), Blocks_(scene.Smoke().Blocks(BlockEdge)),
      CellSums_(field.Cells, Spectrum{}), PatchSums_(field.Patches)
{
  this->Arena_.execute(
    [&]
    {
      this->Balance_ = std::make_unique<DirectBalance>(
        scene, field, this->Blocks_.size(), scene.Smoke().Parts().Parts().size());
    });
}

DirectSolve::~DirectSolve() = default;

template <class Body>
void DirectSolve::ForOwn(std::size_t count, std::size_t grain, double from, double to, Body&& body)
{
  ReportedLoop(
    this->Arena_, this->Team_.OwnCount(count), grain, this->Progress_,
    [&](double done) { this->Progress_.Report(this->Share_ * (from + (to - from) * done)); },
    [&](std::size_t i) { body(this->Team_.OwnItem(i)); });
  this->Progress_.ThrowIfStopped("light field");
}

std::vector<std::size_t> DirectSolve::StrongestFirst(const Medium::Block& block) const
{
  const EmitterSet& lights = this->Scene_.Lights();
  const Vec3 place = this->Scene_.Smoke().CellCentre(this->Scene_.Smoke().Cell(block, {0, 0, 0}));
  std::vector<std::pair<double, std::size_t>> strengths;
  for (std::size_t light = 0; light < lights.Lights().size(); ++light)
  {
    const LightGroup& root = lights.Root(light);
    const Vec3 way = root.Centre - place;
    const double most = *std::max_element(root.Intensity.begin(), root.Intensity.end());
    strengths.emplace_back(-most / (glm::dot(way, way) + root.Area), light);
  }
  std::sort(strengths.begin(), strengths.end());
  std::vector<std::size_t> order;
  for (const auto& [strength, light] : strengths)
  {
    order.push_back(light);
  }
  return order;
}

void DirectSolve::NearCells()
{
  const NearLights& near = this->Scene_.Near(this->Options_.Tolerance);
  const std::vector<NearLights::Cell>& cells = near.Cells();
  const std::size_t lights = this->Scene_.Lights().Lights().size();
  for (std::size_t light = 0; light < lights; ++light)
  {
    this->Arena_.execute([&] { near.Deposit(light); });
    this->Progress_.Report(
      this->Share_ * DepositShare * static_cast<double>(light + 1) / static_cast<double>(lights));
    this->Progress_.ThrowIfStopped("light field");
  }
  this->ForOwn(cells.size(), 4, DepositShare, NearShare,
    [&](std::size_t cell)
    {
      for (std::size_t light = 0; light < cells[cell].Lights.size(); ++light)
      {
        near.Mean(cell, light, 0);
      }
    });
  this->Team_.Complete<float>(
    cells.size(), [&](std::size_t cell, auto&& take) { near.ForEachMean(cell, take); });
}

void DirectSolve::AddParts(const DirectLight& direct)
{
  const std::vector<CellPart>& parts = this->Scene_.Smoke().Parts().Parts();
  if (parts.empty())
  {
    return;
  }
  this->Field_.Report.push_back({"parts of cells", static_cast<double>(parts.size()),
    "surfaces or plates cut the cells: each part has light of its own"});
  this->ForOwn(parts.size(), 16, NearShare, PartShare,
    [&](std::size_t part)
    {
      Spectrum& sum = this->CellSums_[parts[part].Number];
      for (std::size_t light = 0; light < this->Scene_.Lights().Lights().size(); ++light)
      {
        const Spectrum value = direct.PartFluence(light, parts[part]);
        if (this->Balance_->Watches(light))
        {
          this->Balance_->AddToPart(part, light, parts[part].Number, value);
        }
        for (int band = 0; band < this->Field_.Bands; ++band)
        {
          sum[band] += value[band];
        }
      }
    });
  this->Team_.Complete<Spectrum>(parts.size(),
    [&](std::size_t part, auto&& take) { take(this->CellSums_[parts[part].Number]); });
}

std::vector<Spectrum> DirectSolve::SumsIn(std::size_t block, std::size_t light) const
{
  std::vector<Spectrum> sums;
  if (this->Balance_->Watches(light))
  {
    this->Blocks_[block].ForEachCell([&](const std::array<int, 3>& place)
      { sums.push_back(this->CellSums_[this->Scene_.Smoke().Cell(this->Blocks_[block], place)]); });
  }
  return sums;
}

void DirectSolve::Note(std::size_t block, std::size_t light, const std::vector<Spectrum>& before)
{
  if (before.empty())
  {
    return;
  }
  std::size_t number = 0;
  this->Blocks_[block].ForEachCell(
    [&](const std::array<int, 3>& place)
    {
      const std::int64_t cell = this->Scene_.Smoke().Cell(this->Blocks_[block], place);
      Spectrum added = this->CellSums_[cell];
      const Spectrum& earlier = before[number++];
      std::transform(added.begin(), added.end(), earlier.begin(), added.begin(), std::minus<>());
      this->Balance_->AddToCell(block, light, cell, added);
    });
}

void DirectSolve::Cells()
{
  const Medium& smoke = this->Scene_.Smoke();
  if (this->Scene_.Lights().Lights().empty())
  {
    return;
  }
  const double tolerance = this->Options_.Tolerance;
  const DirectLight direct(this->Scene_, &this->Scene_.Near(tolerance), tolerance);
  this->NearCells();
  this->AddParts(direct);
  tbb::combinable<DirectLight::BlockWork> works;
  this->ForOwn(this->Blocks_.size(), 1, PartShare, CellShare,
    [&](std::size_t block)
    {
      const CellsAround around(smoke, this->Blocks_[block]);
      const ClearBorders borders(smoke, around);
      for (const std::size_t light : this->StrongestFirst(this->Blocks_[block]))
      {
        const std::vector<Spectrum> before = this->SumsIn(block, light);
        works.local() +=
          direct.AddBlockFluence(light, around, borders, this->Options_.Skips, this->CellSums_);
        this->Note(block, light, before);
      }
    });
  DirectLight::BlockWork work;
  works.combine_each([&work](const DirectLight::BlockWork& own) { work += own; });
  const auto report = [this](const char* what, std::size_t count, const char* why) {
    this->Field_.Report.push_back({what, static_cast<double>(this->Team_.Sum(count)), why});
  };
  report("optical depths between cells and lights not walked", work.Told,
    "neighbouring cells' ways tell them");
  report("optical depths around blocks of cells not walked", work.ToldAround,
    "ways from the corners of a layer of cells tell them");
  report("looks at far lights through uneven smoke not taken", work.ToldUneven,
    "those from the corners of a block of cells tell them");
  report("direct light of cells not looked for", work.Unseen,
    "they lie behind a light's plate, or something hides all of it");
  report("direct light of cells not computed", work.Negligible,
    "bounds of the light after its way through the smoke lie below 1e-7 of other lights'");
}

void DirectSolve::Patches()
{
  const std::size_t lights = this->Scene_.Lights().Lights().size();
  if (lights == 0)
  {
    return;
  }
  const DirectLight direct(this->Scene_, nullptr, this->Options_.Tolerance);
  const PlateCovers covers(this->Scene_.Shapes(), this->Scene_.EmitterMesh());
  const std::vector<std::vector<Triangle>> patches = TrianglesOfPatches(this->Scene_);
  this->ForOwn(patches.size(), 16, CellShare, 1.0,
    [&](std::size_t patch)
    {
      double area = 0.0;
      // What is dark or covered of the two sides.
      std::array<double, 2> hidden = {
        this->Scene_.EnclosedArea(patch, 0), this->Scene_.EnclosedArea(patch, 1)};
      std::vector<std::array<Spectrum, 2>> ofLights(lights);
      const auto add =
        [&](const Triangle& corners, const Vec3& normal, const std::array<double, 2>& signs)
      {
        const double own = AreaOf(corners);
        for (std::size_t light = 0; light < lights; ++light)
        {
          const auto value = direct.TriangleIlluminance(light, corners, normal);
          for (int side = 0; side < 2; ++side)
          {
            for (int band = 0; band < this->Field_.Bands; ++band)
            {
              ofLights[light][side][band] += signs[side] * own * value[side][band];
            }
          }
        }
      };
      for (const Triangle& corners : patches[patch])
      {
        const Vec3 normal = glm::normalize(AreaVector(corners));
        area += AreaOf(corners);
        add(corners, normal, {1.0, 1.0});
        if (patch >= this->Scene_.SurfacePatches())
        {
          continue;
        }
        // What plates cover is theirs.
        const std::array<std::vector<Triangle>, 2> covered = covers.On(corners);
        for (int side = 0; side < 2; ++side)
        {
          for (const Triangle& part : covered[side])
          {
            hidden[side] += AreaOf(part);
            add(part, normal, {side == 0 ? -1.0 : 0.0, side == 1 ? -1.0 : 0.0});
          }
        }
      }
      for (int side = 0; side < 2; ++side)
      {
        // The mean over what is not hidden, if anything is.
        const bool none = hidden[side] > 0.0 && this->Scene_.ExposedArea(patch, side) == 0.0;
        const double scale = none || !(area > hidden[side]) ? 0.0 : 1.0 / (area - hidden[side]);
        for (std::size_t light = 0; light < lights; ++light)
        {
          Spectrum& own = ofLights[light][side];
          for (int band = 0; band < this->Field_.Bands; ++band)
          {
            // Where plates overlap, they take more than there is.
            own[band] = std::max(0.0, own[band]) * scale;
            this->PatchSums_[patch][side][band] += own[band];
          }
          if (this->Balance_->Watches(light))
          {
            this->Balance_->AddToPatch(patch, side, light, own);
          }
        }
      }
    });
}

void DirectSolve::Finish()
{
  const std::vector<WorkItem> done =
    this->Balance_->MakeUp(this->Team_, this->CellSums_, this->PatchSums_);
  this->Field_.Report.insert(this->Field_.Report.end(), done.begin(), done.end());
  const auto fluence = [this](int band, std::size_t cell) -> float&
  { return this->Field_.DirectFluence[this->Field_.CellIndex(band, cell)]; };
  const auto illuminance = [this](int band, std::size_t patch, int side) -> float&
  { return this->Field_.DirectIlluminance[this->Field_.PatchIndex(band, patch, side)]; };
  for (int band = 0; band < this->Field_.Bands; ++band)
  {
    for (std::size_t cell = 0; cell < this->Field_.Cells; ++cell)
    {
      fluence(band, cell) = static_cast<float>(this->CellSums_[cell][band]);
    }
    for (std::size_t side = 0; side < 2 * this->Field_.Patches; ++side)
    {
      illuminance(band, side / 2, static_cast<int>(side % 2)) =
        static_cast<float>(this->PatchSums_[side / 2][side % 2][band]);
    }
  }
  this->Team_.Complete<float>(this->Blocks_.size(),
    [&](std::size_t block, auto&& take)
    {
      this->Blocks_[block].ForEachCell(
        [&](const std::array<int, 3>& place)
        {
          const std::int64_t cell = this->Scene_.Smoke().Cell(this->Blocks_[block], place);
          for (int band = 0; band < this->Field_.Bands; ++band)
          {
            take(fluence(band, cell));
          }
        });
    });
  this->Team_.Complete<float>(this->Field_.Patches,
    [&](std::size_t patch, auto&& take)
    {
      for (int side = 0; side < 2; ++side)
      {
        for (int band = 0; band < this->Field_.Bands; ++band)
        {
          take(illuminance(band, patch, side));
        }
      }
    });
}

} // namespace smokevis
