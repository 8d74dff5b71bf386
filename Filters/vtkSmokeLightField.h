/**
 * @class   vtkSmokeLightField
 * @brief   the light in smoke and on surfaces, from which any number of views can be made
 *
 * Solves the radiative transfer equation for visible light in smoke (isotropic scattering, diffuse
 * surfaces) and puts out the smoke, surfaces and emitters with the light that reaches them.
 *
 * Inputs, single data sets or collections of them:
 * - port 0, Smoke: vtkImageData or vtkRectilinearGrid with `Extinction`, 1 component, the
 * extinction coefficient at 633 nm [1/m] of cells, or of points (then averaged to cells). Optional
 * on cells: `EmittedLuminance`, 1 component, the luminance of flames [cd/m2]. Where grids overlap
 * the one with the smaller cells counts. Hidden cells count as clear.
 * - port 1, Surfaces (optional, several): `Reflectance`, 1 or 3 components, 0 to 1, of cells.
 * - port 2, Emitters (optional where smoke or sky gives light, several): `Luminance` [cd/m2], 1 or
 * 3 components, of cells, sent out from the front (the right-hand side). Optional:
 * `EmissionExponent` n for luminance times cos^n, `SignId` (int, -1: a lamp), `SignName` (string),
 * `Reflectance`, and a measured spread of light, as vtkLuminaireSource describes it.
 *
 * Output: a collection of the partitioned data sets `Smoke`, `Surfaces` and `Emitters`, which keeps
 * all input arrays and can be saved and read back. Added cell arrays, float, a component a band
 * unless said otherwise:
 * - smoke: `Fluence` and its standard error `FluenceError` [lx]; `DirectFluence`, its part that
 * comes straight from emitters; `MultipleFluence`, the rest in 16 independent batches a band. Of a
 * cell that walls cut, these two are those of its first part, and the field data of the smoke's
 * block hold the others' as `PartDirectFluence` and `PartMultipleFluence`. Of a
 * grid that was refined (MaximumRefinedCells) all are means over its cells, and the field data of
 * its block hold the number of parts of each interval between nodes, `Refinement`, and the light of
 * the finer cells, `RefinedDirectFluence` and `RefinedMultipleFluence`;
 * - surfaces and emitters: `Illuminance` of the front and its standard error `IlluminanceError`
 * [lx]; `IlluminanceBack`; `DirectIlluminance`, front and back of each band; `MultipleIlluminance`,
 * 16 batches of the front, then the back, of each band; of emitters also its gradient over the
 * front, over its mean [1/m], `MultipleIlluminanceGradient`, a vector a band. Surfaces are cut into
 * patches; `ParentCell` is the input cell of each.
 *
 * Field data of the output: `Albedo`, `AngstromExponent`, `Bands`, `ExtinctionScale` (a value a
 * band), `SkyLuminance`, `Tolerance`, `Seed`, `Time` [s] where the smoke has one, and what was done
 * and left out as `WorkReportWhat`, `WorkReportCount`, `WorkReportWhy`.
 *
 * @par References
 * Q. Zhang, P. A. Rubini, Modelling of light extinction by soot particles, Fire Safety Journal 46
 * (2011); J. R. Tramm et al., The random ray method for neutral particle transport, J. Comput.
 * Phys. 342 (2017).
 */
#ifndef vtkSmokeLightField_h
#define vtkSmokeLightField_h

#include "SmokeFiltersModule.h"
#include <vtkPartitionedDataSetCollectionAlgorithm.h>

#include <memory>
#include <vector>

namespace smokevis
{
class Agreement;
struct LightField;
struct SceneBlocks;
struct SceneDescription;
struct SceneOptions;
struct WorkItem;
} // namespace smokevis

class SMOKEFILTERS_EXPORT vtkSmokeLightField : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkSmokeLightField* New();
  vtkTypeMacro(vtkSmokeLightField, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Disconnect all inputs of one kind.
   */
  void RemoveAllSurfaces() { this->SetInputConnection(1, nullptr); }
  void RemoveAllEmitters() { this->SetInputConnection(2, nullptr); }
  ///@}

  ///@{
  /**
   * Single-scattering albedo of the smoke, 0 to 1. Below 0: the field data `Albedo` of the smoke,
   * which the FDS reader fills from the run, else 0.3. Default: -1.
   */
  vtkSetMacro(Albedo, double);
  vtkGetMacro(Albedo, double);
  ///@}

  ///@{
  /**
   * With three bands, the exponent alpha by which extinction grows towards short waves,
   * (633 nm / wavelength)^alpha, -10 to 10. Default: 1, soot of flaming fires.
   */
  vtkSetMacro(AngstromExponent, double);
  vtkGetMacro(AngstromExponent, double);
  ///@}

  enum BandModes
  {
    LUMINANCE = 1,
    RGB = 3
  };

  ///@{
  /**
   * LUMINANCE: one band, extinction as given. RGB: red, green and blue. Default: LUMINANCE.
   */
  vtkSetMacro(Bands, int);
  vtkGetMacro(Bands, int);
  ///@}

  ///@{
  /**
   * Wavelengths of red, green and blue [nm], above 0. Default: (630, 532, 465).
   */
  vtkSetVector3Macro(Wavelengths, double);
  vtkGetVector3Macro(Wavelengths, double);
  ///@}

  ///@{
  /**
   * Reflectance of surfaces that bring none, 0 to 1. Default: 0.5.
   */
  vtkSetMacro(DefaultReflectance, double);
  vtkGetMacro(DefaultReflectance, double);
  ///@}

  ///@{
  /**
   * Luminance of the sky [cd/m2], from 0: daylight. It comes in from all directions, above and
   * below, along every line that meets no surface between the scene and the outside of the box
   * around it. An overcast sky has about 2000 (CIE), a clear one some thousands. Default: 0, dark.
   */
  vtkSetMacro(SkyLuminance, double);
  vtkGetMacro(SkyLuminance, double);
  ///@}

  ///@{
  /**
   * Relative standard error that luminances of the veil are to have, above 0, at most 1. Above 0.05
   * light close to signs and lamps is known to two percent only. Default: 0.01.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Whether work is left out that the scene does not need: lights that add next to nothing to part
   * of the smoke, ways that others tell, steps from cell to cell through clear air, multiple
   * scattering that a bound shows to be a quarter of Tolerance at most, equal bands. Off to measure
   * what that saves. Default: on.
   */
  vtkSetMacro(SkipNeedlessWork, bool);
  vtkGetMacro(SkipNeedlessWork, bool);
  vtkBooleanMacro(SkipNeedlessWork, bool);
  ///@}

  ///@{
  /**
   * Seed of the random numbers, from 0. The same seed gives the same bits. Default: 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Longest edge of the patches that surfaces are cut into [m]; 0: a fiftieth of the diagonal of
   * all geometry. Default: 0.
   */
  vtkSetMacro(PatchSize, double);
  vtkGetMacro(PatchSize, double);
  ///@}

  ///@{
  /**
   * Most cells that grids of thick smoke are refined to, all together, from 0. In white smoke light
   * falls off to walls and away from lights within a mean free path or two. Grids of which more
   * than a hundredth of the smoke is in cells that scatter more than three quarters of an optical
   * depth (of soot, four fifths of all extinction count at least) are solved and looked at in finer
   * cells: of half a depth where that takes an eighth of this number at most, otherwise of 0.75, 1,
   * 1.5 or 2, or of a twentieth of their own. Cells of more than fifteen along their shortest
   * edge stay. Where more than a hundredth juts out of clouds, with thinner smoke beside along two
   * axes or three, and scatters more than 0.3, these become cells of 0.25 or 0.4 if that takes an
   * eighth of this number at most and the Tolerance is 0.02 or less. The output keeps the cells of
   * the input. 0: none are refined. Default: 500000.
   */
  vtkSetMacro(MaximumRefinedCells, int);
  vtkGetMacro(MaximumRefinedCells, int);
  ///@}

  ///@{
  /**
   * Most worker threads, from 0; 0: as many as the machine has. The result does not depend on it.
   * Default: 0.
   */
  vtkSetMacro(Threads, int);
  vtkGetMacro(Threads, int);
  ///@}

protected:
  vtkSmokeLightField();
  ~vtkSmokeLightField() override;

  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int,
    vtkMTimeType* mtime) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSmokeLightField(const vtkSmokeLightField&) = delete;
  void operator=(const vtkSmokeLightField&) = delete;

  void CheckProperties() const;
  /// Warns where an input of surfaces is more than a hundred times larger or smaller than the
  /// smoke.
  void WarnOfUnits(const smokevis::SceneBlocks& blocks, vtkInformationVector* surfaces);
  /// Warns of signs that rather are two with the same id.
  void WarnOfPartedSigns(const smokevis::SceneBlocks& blocks);
  /// Warns where a part of the smoke's cells is too coarse for what it is to tell.
  void WarnOfCoarseCells(const smokevis::LightField& field, const smokevis::SceneBlocks& blocks);
  /// What the properties, and the smoke's own albedo, make of the scene.
  smokevis::SceneOptions Options(
    vtkDataObject* smoke, std::vector<smokevis::WorkItem>& report) const;
  struct Task;

  /// Together with all processes of a parallel run. Returns the time spent on the others [s].
  /// @param agreement that already has the inputs
  double Solve(vtkInformationVector** inputs, smokevis::Agreement& agreement,
    vtkPartitionedDataSetCollection* output);
  void AddProperties(smokevis::Agreement& agreement) const;
  /// Collects the scene.
  void Prepare(vtkInformationVector** inputs, Task& task);
  /// Refines the grids of thick smoke.
  void Refine(Task& task) const;
  /// Solves the light field of the scene and stores it in the scene's blocks.
  void SolveBlocks(Task& task);

  double Albedo = -1.0;
  double AngstromExponent = 1.0;
  int Bands = LUMINANCE;
  double Wavelengths[3] = {630.0, 532.0, 465.0};
  double DefaultReflectance = 0.5;
  double SkyLuminance = 0.0;
  double Tolerance = 0.01;
  bool SkipNeedlessWork = true;
  int Seed = 1;
  double PatchSize = 0.0;
  int MaximumRefinedCells = 500000;
  int Threads = 0;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
