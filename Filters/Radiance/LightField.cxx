#include "LightField.h"

#include "DirectSolve.h"
#include "Errors.h"
#include "LargePages.h"
#include "MultipleSolve.h"
#include "Team.h"

#include <algorithm>
#include <string>

#include <tbb/task_arena.h>

namespace smokevis
{

namespace
{

/// Share of the progress bar that direct light takes.
constexpr double DirectShare = 0.4;

/// The work that one solve goes through.
class Solver
{
public:
  Solver(const Scene& scene, const LightFieldOptions& options, Progress& progress)
      : Scene_(scene), Options_(options), Team_(options.Colleagues ? *options.Colleagues : Alone_),
        Progress_(progress),
        Arena_(options.Threads > 0 ? options.Threads : tbb::task_arena::automatic)
  {
  }

  LightField Run();

private:
  bool BandsEqual(int a, int b) const;
  /// Takes what is not direct in one band for that in another.
  void CopyBand(int from, int to);

  const Scene& Scene_;
  const LightFieldOptions& Options_;
  Team Alone_;
  Team& Team_;
  Progress& Progress_;
  tbb::task_arena Arena_;
  LightField Field_;
};

bool Solver::BandsEqual(int a, int b) const
{
  if (this->Scene_.ExtinctionScale(a) != this->Scene_.ExtinctionScale(b))
  {
    return false;
  }
  for (std::size_t patch = 0; patch < this->Field_.Patches; ++patch)
  {
    const Spectrum& reflectance = this->Scene_.PatchReflectance(patch);
    if (reflectance[a] != reflectance[b])
    {
      return false;
    }
  }
  const auto& cells = this->Scene_.Lights().Cells();
  return std::all_of(cells.begin(), cells.end(),
    [a, b](const EmitterCell& cell) { return cell.Luminance[a] == cell.Luminance[b]; });
}

void Solver::CopyBand(int from, int to)
{
  LightField& field = this->Field_;
  std::copy_n(field.MultipleFluence.begin() + field.CellIndex(from, 0), field.Cells,
    field.MultipleFluence.begin() + field.CellIndex(to, 0));
  std::copy_n(field.MultipleIlluminance.begin() + field.PatchIndex(from, 0, 0), 2 * field.Patches,
    field.MultipleIlluminance.begin() + field.PatchIndex(to, 0, 0));
  const std::size_t emitters = field.MultipleGradient.size() / field.Bands;
  std::copy_n(field.MultipleGradient.begin() + from * emitters, emitters,
    field.MultipleGradient.begin() + to * emitters);
}

LightField Solver::Run()
{
  this->Field_.Bands = this->Scene_.Bands();
  this->Field_.Cells = this->Scene_.Smoke().Cells();
  this->Field_.Patches = this->Scene_.Patches();
  this->Field_.Tolerance = this->Options_.Tolerance;
  const std::size_t bands = this->Field_.Bands;
  ReserveInLargePages(bands * this->Field_.Cells, this->Field_.DirectFluence);
  this->Field_.DirectFluence.assign(bands * this->Field_.Cells, 0.0F);
  ReserveInLargePages(bands * this->Field_.Cells, this->Field_.MultipleFluence);
  this->Field_.MultipleFluence.assign(bands * this->Field_.Cells, Lanes());
  this->Field_.DirectIlluminance.assign(bands * this->Field_.Patches * 2, 0.0F);
  this->Field_.MultipleIlluminance.assign(bands * this->Field_.Patches * 2, Lanes());
  const std::vector<EmitterCell>& cells = this->Scene_.Lights().Cells();
  this->Field_.MultipleGradient.assign(bands * cells.size(), glm::vec3(0.0F));
  const bool shines =
    this->Scene_.Sky() > 0.0 ||
    std::any_of(cells.begin(), cells.end(),
      [this](const EmitterCell& cell)
      {
        return std::any_of(cell.Luminance.begin(), cell.Luminance.begin() + this->Field_.Bands,
          [](double luminance) { return luminance > 0.0; });
      });
  if (!shines && !this->Scene_.Smoke().Emits())
  {
    throw Error("light field", "nothing emits light", "Add a sign, a lamp, a flame or the sky");
  }
  if (!(this->Options_.Tolerance > 0.0))
  {
    throw Error("light field", "the tolerance is not positive", "Give for example 0.01");
  }
  this->Arena_.execute([this] { this->Scene_.Near(this->Options_.Tolerance); });
  DirectSolve direct(this->Scene_, this->Options_, this->Team_, this->Progress_, this->Arena_,
    DirectShare, this->Field_);
  direct.Cells();
  direct.Patches();
  direct.Finish();
  this->Field_.Report.push_back(LeaptAir(this->Scene_.Smoke()));
  MultipleSolve multiple(this->Scene_, this->Options_, this->Team_, this->Progress_, this->Arena_,
    DirectShare, this->Field_);
  for (int band = 0; band < this->Field_.Bands; ++band)
  {
    int same = 0;
    while (same < band && !(this->Options_.Skips && this->BandsEqual(same, band)))
    {
      ++same;
    }
    if (same == band)
    {
      multiple.Band(band);
      continue;
    }
    this->CopyBand(same, band);
    this->Field_.Report.push_back({"band " + std::to_string(band) + " skipped", 1.0,
      "it is equal to band " + std::to_string(same)});
  }
  this->Progress_.Report(1.0);
  return std::move(this->Field_);
}

} // namespace

WorkItem LeaptAir(const Medium& smoke)
{
  const std::int64_t cells = smoke.LeaptCells();
  return {"clear smoke cells leapt over by rays", static_cast<double>(cells),
    cells > 0
      ? "they lie outside the box around a grid's smoke or in bricks of 8 x 8 x 8 without any"
      : "no grid has many that lie outside the box around its smoke or in bricks without any"};
}

LightField SolveLightField(const Scene& scene, const LightFieldOptions& options, Progress& progress)
{
  return Solver(scene, options, progress).Run();
}

} // namespace smokevis
