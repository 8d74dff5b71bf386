#include "vtkSmokeLightField.h"

#include "Errors.h"
#include "Identity.h"
#include "KeptOutput.h"
#include "LightFieldArrays.h"
#include "LightFieldInput.h"
#include "MemoryGuard.h"
#include "PipelineProgress.h"
#include "RankReport.h"
#include "Ranks.h"
#include "SceneBuilder.h"
#include "SceneKeeper.h"
#include "SurfaceRefiner.h"
#include "WholeInput.h"

#include <vtkBoundingBox.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>

#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkSmokeLightField);

namespace
{

/// Wavelength that extinction coefficients are given for [nm].
constexpr double ReferenceWavelength = 633.0;
/// FDS's own default.
constexpr double DefaultAlbedo = 0.3;
/// Patches along the diagonal of all geometry.
constexpr double AutomaticPatches = 50.0;
/// What the solver and the output take for each smoke cell and surface patch, at their peak
/// [bytes]: so much at all, and so much more a band (measured: 250 with one band, 560 with three).
constexpr double CellBytes = 160.0;
constexpr double CellBandBytes = 130.0;
constexpr double PatchBytes = 500.0;
constexpr double PatchBandBytes = 280.0;
/// Ratio of sizes beyond which surfaces and smoke are likely in different units.
constexpr double SuspiciousRatio = 100.0;

using smokevis::Error;
using smokevis::SceneBlocks;
using smokevis::SurfaceBlock;

std::vector<SurfaceBlock> CollectPort(vtkInformationVector* port, const std::string& name)
{
  std::vector<SurfaceBlock> blocks;
  const int count = port->GetNumberOfInformationObjects();
  for (int i = 0; i < count; ++i)
  {
    for (SurfaceBlock& block : smokevis::CollectSurfaces(
           vtkDataObject::GetData(port, i), count == 1 ? name : name + " " + std::to_string(i + 1)))
    {
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

void AddDefaultReflectance(vtkPolyData& mesh, double reflectance)
{
  if (mesh.GetCellData()->HasArray("Reflectance"))
  {
    return;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName("Reflectance");
  array->SetNumberOfTuples(mesh.GetNumberOfCells());
  array->Fill(reflectance);
  mesh.GetCellData()->AddArray(array);
}

double Diagonal(const SceneBlocks& blocks)
{
  vtkBoundingBox box;
  for (const smokevis::SmokeBlock& block : blocks.Smoke)
  {
    box.AddBounds(block.Grid->GetBounds());
  }
  for (const auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (const SurfaceBlock& block : *group)
    {
      box.AddBounds(block.Mesh->GetBounds());
    }
  }
  return box.GetDiagonalLength();
}

double Diagonal(const std::vector<SurfaceBlock>& blocks)
{
  SceneBlocks scene;
  scene.Surfaces = blocks;
  return Diagonal(scene);
}

/// Cuts the blocks and drops those of which nothing is left. Returns the number of patches.
std::size_t Refine(std::vector<SurfaceBlock>& blocks, double patchSize)
{
  std::size_t patches = 0;
  std::vector<SurfaceBlock> refined;
  for (const SurfaceBlock& block : blocks)
  {
    const auto mesh = smokevis::RefineSurface(block.Mesh, block.Name, patchSize);
    if (mesh->GetNumberOfCells() > 0)
    {
      patches += mesh->GetNumberOfCells();
      refined.push_back({block.Name, mesh});
    }
  }
  blocks = std::move(refined);
  return patches;
}

template <class Block>
void AddPartitions(vtkPartitionedDataSetCollection* output, unsigned int index, const char* name,
  const std::vector<Block>& blocks)
{
  vtkNew<vtkPartitionedDataSet> partitions;
  partitions->SetNumberOfPartitions(static_cast<unsigned int>(blocks.size()));
  for (unsigned int i = 0; i < blocks.size(); ++i)
  {
    if constexpr (std::is_same_v<Block, smokevis::SmokeBlock>)
    {
      partitions->SetPartition(i, blocks[i].Grid);
    }
    else
    {
      partitions->SetPartition(i, blocks[i].Mesh);
    }
    partitions->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), blocks[i].Name.c_str());
  }
  output->SetPartitionedDataSet(index, partitions);
  output->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name);
}

/// Leaves every so many-th block, which a view of a parallel run is to draw.
void DivideBlocks(vtkPartitionedDataSetCollection& output, const std::pair<int, int>& piece)
{
  for (unsigned int i = 0; i < output.GetNumberOfPartitionedDataSets(); ++i)
  {
    for (unsigned int j = 0; j < output.GetNumberOfPartitions(i); ++j)
    {
      if (static_cast<int>(j) % piece.second != piece.first)
      {
        output.SetPartition(i, j, static_cast<vtkDataObject*>(nullptr));
      }
    }
  }
}

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
  /// What Kept was made of: the inputs, and the filter's properties as of then.
  std::vector<std::uint64_t> MadeOf;
  vtkMTimeType MadeWith = 0;
  smokevis::SceneKeeper Scenes;
  SolvedLight Solved;
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
  const auto check = [](bool good, const char* name, const char* what, const char* remedy)
  {
    if (!good)
    {
      throw Error(name, what, remedy);
    }
  };
  check(this->Albedo <= 1.0, "Albedo", "it is above 1", "Give 0 to 1, or -1 for the smoke's own");
  check(std::abs(this->AngstromExponent) <= 10.0, "AngstromExponent", "it is outside -10 to 10",
    "Give 1 for soot of flaming fires");
  check(this->Bands == LUMINANCE || this->Bands == RGB, "Bands", "it is neither 1 nor 3",
    "Choose Luminance or RGB");
  for (const double wavelength : this->Wavelengths)
  {
    check(wavelength > 0.0 && std::isfinite(wavelength), "Wavelengths", "one is not positive",
      "Give wavelengths in nm");
  }
  check(this->DefaultReflectance >= 0.0 && this->DefaultReflectance <= 1.0, "DefaultReflectance",
    "it is outside 0 to 1", "Give a diffuse reflectance");
  check(this->Tolerance > 0.0 && this->Tolerance <= 1.0, "Tolerance",
    "it is not above 0 and at most 1", "Give 0.01 for 1 %");
  check(this->SkyLuminance >= 0.0 && std::isfinite(this->SkyLuminance), "SkyLuminance",
    "it is negative or not finite", "Give a luminance in cd/m2, or 0 for a dark outside");
  check(this->Seed >= 0, "Seed", "it is negative", "Give a whole number from 0");
  check(this->PatchSize >= 0.0 && std::isfinite(this->PatchSize), "PatchSize",
    "it is negative or not finite", "Give a length in metres, or 0 for an automatic one");
  check(this->Threads >= 0, "Threads", "it is negative", "Give 0 for all of the machine");
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::WarnOfUnits(const SceneBlocks& blocks, vtkInformationVector* surfaces)
{
  SceneBlocks smokeOnly;
  smokeOnly.Smoke = blocks.Smoke;
  const double smoke = Diagonal(smokeOnly);
  for (int i = 0; i < surfaces->GetNumberOfInformationObjects(); ++i)
  {
    const double model =
      Diagonal(smokevis::CollectSurfaces(vtkDataObject::GetData(surfaces, i), "Surfaces"));
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
void vtkSmokeLightField::SolveBlocks(smokevis::SceneDescription description,
  const SceneBlocks& blocks, std::vector<smokevis::WorkItem>& report)
{
  const auto scene = this->Implementation->Scenes.Make(std::move(description));
  report.push_back({"search structures built", scene->SharesShapes() ? 0.0 : 1.0,
    scene->SharesShapes() ? "those of the light field before hold the same shapes"
                          : "shapes are new"});
  smokevis::LightFieldOptions solver;
  solver.Tolerance = this->Tolerance;
  solver.Skips = this->SkipNeedlessWork;
  solver.Seed = static_cast<std::uint64_t>(this->Seed);
  // TBB warns on the console about threads that the machine does not have.
  solver.Threads = std::min(this->Threads, tbb::info::default_concurrency());
  smokevis::LightField field;
  smokevis::RunWithProgress(this, 0.02, 0.98,
    [&](smokevis::Progress& progress)
    { field = smokevis::SolveLightField(*scene, solver, progress); });
  report.insert(report.end(), field.Report.begin(), field.Report.end());
  smokevis::StoreLightField(std::move(field), blocks, this->Bands);
}

//------------------------------------------------------------------------------
void vtkSmokeLightField::Solve(
  vtkInformationVector** inputs, vtkPartitionedDataSetCollection* output)
{
  this->CheckProperties();
  std::vector<smokevis::WorkItem> report;
  vtkDataObject* const smoke = vtkDataObject::GetData(inputs[0]);
  SceneBlocks blocks;
  blocks.Smoke = smokevis::CollectSmoke(smoke, "Smoke");
  blocks.Surfaces = CollectPort(inputs[1], "Surfaces");
  blocks.Emitters = CollectPort(inputs[2], "Emitters");
  if (blocks.Smoke.empty())
  {
    throw Error("Smoke", "the input holds no grid",
      "Connect a reader of smoke, or an image with Extinction 0 for clear air");
  }
  this->WarnOfUnits(blocks, inputs[1]);
  bool smokeEmits = false;
  for (const smokevis::SmokeBlock& block : blocks.Smoke)
  {
    smokeEmits = smokeEmits || block.Grid->GetCellData()->HasArray("EmittedLuminance");
  }

  const double patchSize =
    this->PatchSize > 0.0 ? this->PatchSize : Diagonal(blocks) / AutomaticPatches;
  for (const SurfaceBlock& block : blocks.Surfaces)
  {
    AddDefaultReflectance(*block.Mesh, this->DefaultReflectance);
  }
  report.push_back({"Surface patches", static_cast<double>(Refine(blocks.Surfaces, patchSize)),
    "surfaces are cut to edges of at most " + std::to_string(patchSize) + " m"});
  Refine(blocks.Emitters, std::numeric_limits<double>::infinity());
  if (blocks.Emitters.empty() && !smokeEmits && this->SkyLuminance == 0.0)
  {
    throw Error("Emitters", "nothing gives light",
      "Connect signs or lamps, such as the sources ExitSign and Luminaire, or set SkyLuminance");
  }

  std::vector<SurfaceBlock*> patches;
  for (auto* const group : {&blocks.Surfaces, &blocks.Emitters})
  {
    for (SurfaceBlock& block : *group)
    {
      patches.push_back(&block);
    }
  }
  smokevis::MatchComponents(patches, "Reflectance");
  smokevis::MatchComponents(patches, "Luminance");

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

  double cells = 0.0;
  for (const smokevis::SmokeBlock& block : blocks.Smoke)
  {
    cells += static_cast<double>(block.Grid->GetNumberOfCells());
  }
  double count = 0.0;
  for (const SurfaceBlock* const block : patches)
  {
    count += static_cast<double>(block->Mesh->GetNumberOfCells());
  }
  smokevis::RequireMemory("light field",
    "the light of " + std::to_string(std::llround(cells)) + " smoke cells and " +
      std::to_string(std::llround(count)) + " surface patches",
    cells * (CellBytes + CellBandBytes * this->Bands) +
      count * (PatchBytes + PatchBandBytes * this->Bands),
    "Give coarser smoke, one band or a larger PatchSize");

  smokevis::SceneDescription description = smokevis::BuildScene(blocks, options);
  if (this->Bands == RGB && smokevis::BandsAreEqual(description))
  {
    description.Bands = 1;
    report.push_back({"Bands left out", 2.0, "all bands are equal and were solved once"});
  }
  Internals::SolvedLight& last = this->Implementation->Solved;
  if (last.Tolerance == this->Tolerance && last.Skips == this->SkipNeedlessWork &&
      last.Seed == this->Seed && last.Bands == this->Bands &&
      this->Implementation->Scenes.IsLast(description) &&
      smokevis::ShareLightField(last.Blocks, blocks))
  {
    report.push_back({"light fields solved", 0.0,
      "smoke, surfaces and emitters are those of the light field before, which is kept"});
  }
  else
  {
    last = {};
    this->SolveBlocks(std::move(description), blocks, report);
    last = {blocks, this->Tolerance, this->SkipNeedlessWork, this->Seed, this->Bands};
  }

  output->SetNumberOfPartitionedDataSets(3);
  AddPartitions(output, 0, "Smoke", blocks.Smoke);
  AddPartitions(output, 1, "Surfaces", blocks.Surfaces);
  AddPartitions(output, 2, "Emitters", blocks.Emitters);

  // File formats drop the field data of a collection, so a block of each kind has them as well.
  std::vector<vtkDataObject*> targets = {output};
  for (unsigned int i = 0; i < output->GetNumberOfPartitionedDataSets(); ++i)
  {
    if (output->GetNumberOfPartitions(i) > 0)
    {
      targets.push_back(output->GetPartitionAsDataObject(i, 0));
    }
  }
  for (vtkDataObject* const target : targets)
  {
    vtkNew<vtkFieldData> fields;
    fields->PassData(target->GetFieldData());
    fields->PassData(smoke->GetFieldData());
    target->SetFieldData(fields);
    smokevis::AddFieldNumber(*target, "Albedo", {options.Albedo});
    smokevis::AddFieldNumber(*target, "AngstromExponent", {this->AngstromExponent});
    smokevis::AddFieldNumber(*target, "Bands", {static_cast<double>(this->Bands)});
    const smokevis::Spectrum& scale = options.ExtinctionScale;
    if (this->Bands == RGB)
    {
      smokevis::AddFieldNumber(*target, "ExtinctionScale", {scale[0], scale[1], scale[2]});
    }
    else
    {
      smokevis::AddFieldNumber(*target, "ExtinctionScale", {scale[0]});
    }
    smokevis::AddFieldNumber(*target, "SkyLuminance", {this->SkyLuminance});
    smokevis::AddFieldNumber(*target, "Tolerance", {this->Tolerance});
    smokevis::AddFieldNumber(*target, "Seed", {static_cast<double>(this->Seed)});
    vtkInformation* const info = smoke->GetInformation();
    if (info->Has(vtkDataObject::DATA_TIME_STEP()))
    {
      const double time = info->Get(vtkDataObject::DATA_TIME_STEP());
      smokevis::AddFieldNumber(*target, "Time", {time});
      target->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    }
    smokevis::AddWorkReport(*target, report);
  }
}

//------------------------------------------------------------------------------
int vtkSmokeLightField::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPartitionedDataSetCollection* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  Internals& own = *this->Implementation;
  const smokevis::Ranks ranks;
  try
  {
    // A parallel run asks for the whole and for pieces in turn, for which readers read anew: for
    // the same contents its former output is divided in another way, and nothing else is done.
    std::vector<std::uint64_t> contents;
    for (int port = 0; port < this->GetNumberOfInputPorts() && ranks.Count() > 1; ++port)
    {
      for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
      {
        contents.push_back(port);
        contents.push_back(smokevis::Fingerprint(vtkDataObject::GetData(inputVector[port], i)));
      }
    }
    const bool isNew = ranks.Count() == 1 || !own.Kept.Has(0) || own.MadeOf != contents ||
                       own.MadeWith != this->GetMTime();
    if (ranks.Most(isNew ? 1 : 0) > 0)
    {
      own.MadeWith = 0;
      const auto start = std::chrono::steady_clock::now();
      ranks.Together(this, [&] { this->Solve(inputVector, output); });
      if (ranks.Count() > 1)
      {
        constexpr double kibibyte = 1024.0;
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        const double bytes = kibibyte * static_cast<double>(output->GetActualMemorySize());
        smokevis::ReportRanks(*output->GetFieldData(),
          {ranks.Each(taken.count()), "each process solves the whole light field"},
          {ranks.Each(bytes), "each process holds the whole light field"});
      }
      own.Kept.Keep(outputVector, 0);
      own.MadeOf = contents;
      own.MadeWith = this->GetMTime();
    }
    else
    {
      own.Kept.Show(outputVector, 0);
    }
    DivideBlocks(*output, smokevis::AskedPiece(outputVector->GetInformationObject(0)));
    return 1;
  }
  catch (const std::exception& error)
  {
    if (this->GetAbortOutput())
    {
      this->Implementation->Kept.Restore(this, outputVector, 0);
      DivideBlocks(*output, smokevis::AskedPiece(outputVector->GetInformationObject(0)));
      return 1;
    }
    this->Implementation->Kept.Clear();
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
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
  os << indent << "Threads: " << this->Threads << "\n";
}
