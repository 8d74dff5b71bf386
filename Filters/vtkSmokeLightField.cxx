#include "vtkSmokeLightField.h"

#include "Agreement.h"
#include "Errors.h"
#include "KeptOrigin.h"
#include "KeptOutput.h"
#include "LightFieldArrays.h"
#include "LightFieldInput.h"
#include "LightFieldOutput.h"
#include "PropertyChecks.h"
#include "RankTeam.h"
#include "Ranks.h"
#include "SceneBuilder.h"
#include "SceneKeeper.h"
#include "ScenePreparation.h"
#include "SignList.h"
#include "WholeInput.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>

#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>

vtkStandardNewMacro(vtkSmokeLightField);

namespace
{

/// Wavelength that extinction coefficients are given for [nm].
constexpr double ReferenceWavelength = 633.0;
/// FDS's own default.
constexpr double DefaultAlbedo = 0.3;
/// Patches along the diagonal of all geometry.
constexpr double AutomaticPatches = 50.0;
/// Ratio of sizes beyond which surfaces and smoke are likely in different units.
constexpr double SuspiciousRatio = 100.0;

using smokevis::Error;
using smokevis::SceneBlocks;

} // namespace

//------------------------------------------------------------------------------
struct vtkSmokeLightField::Internals
{
  /// How the light of the last scene was solved, and the blocks that hold it; none: no blocks.
  struct SolvedLight
  {
    SceneBlocks Blocks;
    double Tolerance = 0.0;
    bool Skips = true;
    int Seed = 0;
    int Bands = 0;
  };

  smokevis::KeptOutput Kept;
  /// Of Kept: port and checksum of each input.
  smokevis::KeptOrigin<std::vector<std::uint64_t>> Origin;
  smokevis::SceneKeeper Scenes;
  SolvedLight Solved;
};

//------------------------------------------------------------------------------
/// What one execution has to do.
struct vtkSmokeLightField::Task
{
  SceneBlocks Blocks;
  smokevis::SceneOptions Options;
  smokevis::SceneDescription Description;
  std::vector<smokevis::WorkItem> Report;
  /// Whether the light field is that of the last scene, and in the blocks already.
  bool IsKept = false;
  /// Time spent on other processes [s].
  double Waited = 0.0;
};

//------------------------------------------------------------------------------
vtkSmokeLightField::vtkSmokeLightField() : Implementation(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(3);
}

//------------------------------------------------------------------------------
vtkSmokeLightField::~vtkSmokeLightField() = default;

//------------------------------------------------------------------------------
int vtkSmokeLightField::ComputePipelineMTime(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType* mtime)
{
  *mtime = this->Implementation->Kept.PipelineMTime(this->GetMTime());
  return 1;
}

//------------------------------------------------------------------------------
int vtkSmokeLightField::FillInputPortInformation(int port, vtkInformation* info)
{
  // Collections come first: the pipeline then hands them over whole.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkSmokeLightField::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  smokevis::HandlePieces(outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSmokeLightField::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    smokevis::RequestWholeInputs(inputVector[port]);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::CheckProperties() const
{
  smokevis::Check(
    this->Albedo <= 1.0, "Albedo", "it is not at most 1", "Give 0 to 1, or -1 for the smoke's own");
  smokevis::Check(std::abs(this->AngstromExponent) <= 10.0, "AngstromExponent",
    "it is outside -10 to 10", "Give 1 for soot of flaming fires");
  smokevis::Check(this->Bands == LUMINANCE || this->Bands == RGB, "Bands", "it is neither 1 nor 3",
    "Choose Luminance or RGB");
  for (const double wavelength : this->Wavelengths)
  {
    smokevis::Check(smokevis::IsPositive(wavelength), "Wavelengths", "one is not positive",
      "Give wavelengths in nm");
  }
  smokevis::Check(this->DefaultReflectance >= 0.0 && this->DefaultReflectance <= 1.0,
    "DefaultReflectance", "it is outside 0 to 1", "Give a diffuse reflectance");
  smokevis::Check(this->Tolerance > 0.0 && this->Tolerance <= 1.0, "Tolerance",
    "it is not above 0 and at most 1", "Give 0.01 for 1 %");
  smokevis::Check(smokevis::IsNotNegative(this->SkyLuminance), "SkyLuminance",
    "it is negative or not finite", "Give a luminance in cd/m2, or 0 for a dark outside");
  smokevis::Check(this->Seed >= 0, "Seed", "it is negative", "Give a whole number from 0");
  smokevis::Check(smokevis::IsNotNegative(this->PatchSize), "PatchSize",
    "it is negative or not finite", "Give a length in metres, or 0 for an automatic one");
  smokevis::Check(this->MaximumRefinedCells >= 0, "MaximumRefinedCells", "it is negative",
    "Give 0 to refine no smoke");
  smokevis::Check(this->Threads >= 0, "Threads", "it is negative", "Give 0 for all of the machine");
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::WarnOfUnits(const SceneBlocks& blocks, vtkInformationVector* surfaces)
{
  SceneBlocks smokeOnly;
  smokeOnly.Smoke = blocks.Smoke;
  const double smoke = smokevis::Diagonal(smokeOnly);
  for (int i = 0; i < surfaces->GetNumberOfInformationObjects(); ++i)
  {
    SceneBlocks modelOnly;
    modelOnly.Surfaces = smokevis::CollectSurfaces(vtkDataObject::GetData(surfaces, i), "Surfaces");
    const double model = smokevis::Diagonal(modelOnly);
    if (model > 0.0 && (model > SuspiciousRatio * smoke || smoke > SuspiciousRatio * model))
    {
      vtkWarningMacro(<< "Surfaces: input " << i + 1 << " is " << model
                      << " m across and the smoke " << smoke
                      << " m. Is one of them in millimetres? A CAD Reader has UnitScale, other "
                      << "data the filter Transform.");
    }
  }
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::WarnOfPartedSigns(const SceneBlocks& blocks)
{
  for (const auto& [id, sign] : smokevis::FindPartedSigns(blocks.Emitters))
  {
    vtkWarningMacro(<< "Emitters: '" << sign.One << "' and '" << sign.Other
                    << "' both have cells of SignId " << id << ", " << sign.Gap
                    << " m apart, which are measured as one sign. Give each sign a SignId of its "
                    << "own.");
  }
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::WarnOfCoarseCells(
  const smokevis::LightField& field, const SceneBlocks& blocks)
{
  double given = 0.0;
  for (const smokevis::SmokeBlock& block : blocks.Smoke)
  {
    given += static_cast<double>(block.Grid->GetNumberOfCells());
  }
  // Refined cells are no reason to keep silent about others.
  if (static_cast<double>(field.CoarseCells) > smokevis::TolerableThickShare * given)
  {
    vtkWarningMacro(
      << "Smoke: " << field.CoarseCells << " of the " << field.Cells
      << " cells that it is solved in"
      << " are so thick that light is scattered more than once on a mean way "
      << "through them. What lies in the dark behind several of them may come out "
      << "a third too bright, in white smoke half as bright as it is, and many times too bright "
      << "where they are thicker than four mean free paths, which no error bar tells. The "
      << "WorkReport says whether a larger MaximumRefinedCells helps; otherwise give smoke on a "
      << "finer grid.");
  }
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::SolveBlocks(Task& task)
{
  const smokevis::Ranks ranks;
  std::shared_ptr<const smokevis::Scene> scene;
  ranks.Together(
    this, [&] { scene = this->Implementation->Scenes.Make(std::move(task.Description)); });
  task.Report.push_back({"search structures built", scene->SharesShapes() ? 0.0 : 1.0,
    scene->SharesShapes() ? "those of the light field before hold the same shapes"
                          : "shapes are new"});
  smokevis::RankTeam team(this);
  smokevis::LightFieldOptions solver;
  solver.Tolerance = this->Tolerance;
  solver.Skips = this->SkipNeedlessWork;
  solver.Seed = static_cast<std::uint64_t>(this->Seed);
  // TBB warns on the console about threads that the machine does not have.
  solver.Threads = std::min(this->Threads, tbb::info::default_concurrency());
  solver.Colleagues = &team;
  smokevis::LightField field;
  team.Run(0.02, 0.98,
    [&](smokevis::Progress& progress)
    { field = smokevis::SolveLightField(*scene, solver, progress); });
  task.Waited = team.Waited();
  task.Report.insert(task.Report.end(), field.Report.begin(), field.Report.end());
  this->WarnOfCoarseCells(field, task.Blocks);
  ranks.Together(this,
    [&] { smokevis::StoreLightField(std::move(field), scene->Smoke(), task.Blocks, this->Bands); });
}

//------------------------------------------------------------------------------
smokevis::SceneOptions vtkSmokeLightField::Options(
  vtkDataObject* smoke, std::vector<smokevis::WorkItem>& report) const
{
  smokevis::SceneOptions options;
  options.Bands = this->Bands;
  if (this->Bands == RGB)
  {
    for (int band = 0; band < this->Bands; ++band)
    {
      options.ExtinctionScale[band] =
        std::pow(ReferenceWavelength / this->Wavelengths[band], this->AngstromExponent);
    }
  }
  options.Sky = this->SkyLuminance;
  options.Albedo = this->Albedo;
  const char* why = "the property";
  if (this->Albedo < 0.0)
  {
    const bool given = smokevis::FieldNumber(smoke, "Albedo", 0, options.Albedo);
    options.Albedo = given ? options.Albedo : DefaultAlbedo;
    why = given ? "the smoke's field data" : "neither property nor smoke gave one";
    if (!(options.Albedo >= 0.0 && options.Albedo <= 1.0))
    {
      throw Error(
        "field data Albedo of the smoke", "it is outside 0 to 1", "Set the property Albedo");
    }
  }
  report.push_back({"Albedo", options.Albedo, why});
  return options;
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::AddProperties(smokevis::Agreement& agreement) const
{
  agreement.Add("Albedo", this->Albedo);
  agreement.Add("AngstromExponent", this->AngstromExponent);
  agreement.Add("Bands", this->Bands);
  agreement.Add("Wavelengths", this->Wavelengths, 3);
  agreement.Add("DefaultReflectance", this->DefaultReflectance);
  agreement.Add("SkyLuminance", this->SkyLuminance);
  agreement.Add("Tolerance", this->Tolerance);
  agreement.Add("SkipNeedlessWork", this->SkipNeedlessWork);
  agreement.Add("Seed", this->Seed);
  agreement.Add("PatchSize", this->PatchSize);
  agreement.Add("MaximumRefinedCells", this->MaximumRefinedCells);
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::Refine(Task& task) const
{
  const smokevis::ThickSmoke thick = smokevis::FindThickSmoke(
    task.Description, static_cast<std::size_t>(this->MaximumRefinedCells), this->Tolerance);
  for (std::size_t i = 0; i < thick.Refinements.size(); ++i)
  {
    task.Blocks.Smoke[i].Refinement = thick.Refinements[i];
  }
  smokevis::RequireMemoryForLight(task.Blocks, this->Bands);
  smokevis::Refine(task.Description.Grids, thick.Refinements);

  std::ostringstream why;
  if (thick.IsRefined() && thick.Thick > 0)
  {
    why << "light varies inside them: grids are solved in " << thick.Cells << " cells, of at most "
        << thick.Depth << " scattering depths or a twentieth of their own";
  }
  else if (thick.Thick > 0)
  {
    why << thick.Thick << " thick cells would take " << thick.Cells
        << " cells at least, more than MaximumRefinedCells";
  }
  else if (thick.Opaque > 0)
  {
    why << thick.Opaque
        << " cells are next to opaque: they scatter more than fifteen depths, and are left as they "
           "are";
  }
  else
  {
    why << (task.Options.Albedo > 0.0 ? "no more than a hundredth of a grid's smoke is so thick"
                                      : "smoke that scatters no light needs no finer cells");
  }
  task.Report.push_back({"thick smoke cells refined",
    thick.IsRefined() ? static_cast<double>(thick.Thick) : 0.0, why.str()});
  if (thick.Jutting > 0)
  {
    const bool refined = thick.IsRefined() && std::isfinite(thick.JuttingDepth);
    std::ostringstream whyJutting;
    whyJutting << "light comes into " << thick.Jutting << " cells from several sides: ";
    if (refined)
    {
      whyJutting << "grids are solved in " << thick.Cells << " cells, there of at most "
                 << thick.JuttingDepth << " scattering depths or a twentieth of their own";
    }
    else
    {
      whyJutting << "finer cells would be more than an eighth of MaximumRefinedCells";
    }
    task.Report.push_back({"cells that jut out of clouds refined",
      refined ? static_cast<double>(thick.Jutting) : 0.0, whyJutting.str()});
  }
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::Prepare(vtkInformationVector** inputs, Task& task)
{
  this->CheckProperties();
  std::vector<smokevis::WorkItem>& report = task.Report;
  vtkDataObject* const smoke = vtkDataObject::GetData(inputs[0]);
  SceneBlocks& blocks = task.Blocks;
  blocks.Smoke = smokevis::CollectSmoke(smoke, "Smoke");
  blocks.Surfaces = smokevis::CollectPort(inputs[1], "Surfaces");
  blocks.Emitters = smokevis::CollectPort(inputs[2], "Emitters");
  if (blocks.Smoke.empty())
  {
    throw Error("Smoke", "the input holds no grid",
      "Connect a reader of smoke, or an image with Extinction 0 for clear air");
  }
  this->WarnOfUnits(blocks, inputs[1]);

  const double patchSize =
    this->PatchSize > 0.0 ? this->PatchSize : smokevis::Diagonal(blocks) / AutomaticPatches;
  smokevis::AddDefaultReflectance(blocks.Surfaces, this->DefaultReflectance);
  report.push_back(
    {"Surface patches", static_cast<double>(smokevis::CutIntoPatches(blocks, patchSize)),
      "surfaces are cut to edges of at most " + std::to_string(patchSize) + " m"});
  if (blocks.Emitters.empty() && !smokevis::SmokeEmits(blocks) && this->SkyLuminance == 0.0)
  {
    throw Error("Emitters", "nothing gives light",
      "Connect signs or lamps, such as the sources ExitSign and Luminaire, or set SkyLuminance");
  }
  task.Options = this->Options(smoke, report);
  smokevis::RequireMemoryForLight(blocks, this->Bands);

  task.Description = smokevis::BuildScene(blocks, task.Options);
  this->WarnOfPartedSigns(blocks);
  this->Refine(task);
  task.Description.LeapsClearAir = this->SkipNeedlessWork;
  if (this->Bands == RGB && this->SkipNeedlessWork && smokevis::BandsAreEqual(task.Description))
  {
    task.Description.Bands = 1;
    report.push_back({"Bands left out", 2.0, "all bands are equal and were solved once"});
  }
  const Internals::SolvedLight& last = this->Implementation->Solved;
  task.IsKept = last.Tolerance == this->Tolerance && last.Skips == this->SkipNeedlessWork &&
                last.Seed == this->Seed && last.Bands == this->Bands &&
                this->Implementation->Scenes.IsLast(task.Description) &&
                smokevis::ShareLightField(last.Blocks, blocks);
}

//------------------------------------------------------------------------------
double vtkSmokeLightField::Solve(vtkInformationVector** inputs, smokevis::Agreement& agreement,
  vtkPartitionedDataSetCollection* output)
{
  const smokevis::Ranks ranks;
  Task task;
  ranks.Together(this, [&] { this->Prepare(inputs, task); });
  this->AddProperties(agreement);
  agreement.Check();
  // Processes may have kept different things when one of them was stopped.
  if (ranks.Most(task.IsKept ? 0 : 1) == 0)
  {
    task.Report.push_back({"light fields solved", 0.0,
      "smoke, surfaces and emitters are those of the light field before, which is kept"});
  }
  else
  {
    Internals::SolvedLight& last = this->Implementation->Solved;
    last = {};
    this->SolveBlocks(task);
    last = {task.Blocks, this->Tolerance, this->SkipNeedlessWork, this->Seed, this->Bands};
  }
  ranks.Together(this,
    [&]
    {
      smokevis::AddBlocks(*output, task.Blocks);
      smokevis::AddFields(*output, *vtkDataObject::GetData(inputs[0]),
        {task.Options, this->AngstromExponent, this->Tolerance, this->Seed}, task.Report);
    });
  return task.Waited;
}

//------------------------------------------------------------------------------
int vtkSmokeLightField::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* const output = vtkPartitionedDataSetCollection::GetData(outputVector);
  Internals& own = *this->Implementation;
  const smokevis::Ranks ranks;
  const auto work = [&]
  {
    // A parallel run asks for the whole and for pieces in turn, for which readers read anew: for
    // the same contents its former output is divided in another way, and nothing else is done.
    smokevis::Agreement agreement(ranks);
    agreement.Add("Smoke", inputVector[0]);
    agreement.Add("Surfaces", inputVector[1]);
    agreement.Add("Emitters", inputVector[2]);
    std::optional<std::vector<std::uint64_t>> contents;
    if (ranks.Count() > 1)
    {
      contents = agreement.Sums();
    }
    own.Origin.Renew(this, outputVector, own.Kept, contents,
      [&]
      {
        const auto start = std::chrono::steady_clock::now();
        const double waited = this->Solve(inputVector, agreement, output);
        const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
        smokevis::ReportRanks(ranks, *output, all.count() - waited, waited);
      });
  };
  const int done = own.Kept.Produce(this, outputVector, work);
  smokevis::DivideBlocks(*output, smokevis::AskedPiece(outputVector->GetInformationObject(0)));
  return done;
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Albedo: " << this->Albedo << "\n";
  os << indent << "AngstromExponent: " << this->AngstromExponent << "\n";
  os << indent << "Bands: " << this->Bands << "\n";
  os << indent << "Wavelengths: (" << this->Wavelengths[0] << ", " << this->Wavelengths[1] << ", "
     << this->Wavelengths[2] << ")\n";
  os << indent << "DefaultReflectance: " << this->DefaultReflectance << "\n";
  os << indent << "SkyLuminance: " << this->SkyLuminance << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "SkipNeedlessWork: " << this->SkipNeedlessWork << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "PatchSize: " << this->PatchSize << "\n";
  os << indent << "MaximumRefinedCells: " << this->MaximumRefinedCells << "\n";
  os << indent << "Threads: " << this->Threads << "\n";
}
