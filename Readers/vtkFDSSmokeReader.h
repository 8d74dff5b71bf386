/**
 * @class vtkFDSSmokeReader
 * @brief Reads smoke, flames, walls and measurements of an FDS run.
 *
 * The input is the index that FDS writes for Smokeview, CHID.smv, with the files it names beside
 * it. Files that an output does not need may be missing. An output is read only when it is asked
 * for.
 *
 * Output 0, Smoke, is a vtkPartitionedDataSetCollection with one vtkRectilinearGrid a mesh, named
 * after the mesh, with these cell arrays:
 *  - `Extinction` (float, 1 component): extinction coefficient K at 633 nm [1/m]; 0 in solids and
 *    where the run wrote no data.
 *  - `Solid` (unsigned char, 1 component): 1 in cells inside an obstruction that is there at that
 *    time, else 0.
 *  - `EmittedLuminance` (float, 1 component): luminance L_emit [cd/m2] of the flames, where the run
 *    wrote what the flame model needs.
 *
 * Its field data, on the collection and on each grid, are `ExtinctionSource` (string: the
 * quantities and files used), `Albedo` (double, 0 to 1: single-scattering albedo), `Time` (double:
 * time of the data [s]) and `CHID` (string); with flames also `FlameSource` (string: model and
 * files), `FlameHeatRelease` [W] where the run wrote HRRPUV in 3-D, `FlameLumens` and
 * `FlameLumensPlaced` [lm], each over all meshes: the light that the model asks for, and what of it
 * the smoke of burning cells sends out.
 *
 * The collections of all outputs also have the field data `WorkReportWhat`, `WorkReportCount` and
 * `WorkReportWhy`: two rows a process, "seconds of process 0", the time that reading took it [s],
 * and "bytes of process 0", how much it read of the run's files for this time step. Files that are
 * opened for the first time for it, as those of Slices and Boundary are, count with their headers.
 *
 * K comes, on each mesh and for each smoke species, from the best of what the run wrote in 3-D:
 *  -# cell-centred slices of EXTINCTION COEFFICIENT, OPTICAL DENSITY, DENSITY of the species, MASS
 *     FRACTION with the gas DENSITY, the latter two where the mass extinction coefficient is known;
 *  -# the same of nodes, which blur K over neighbouring cells, or with FDS's default coefficient;
 *  -# 8-bit smoke (.s3d, .s3dd) that holds density;
 *  -# Plot3D;
 *  -# slices of VISIBILITY, which is capped;
 *  -# 8-bit smoke that holds opacity.
 *
 * Parts of a mesh are completed by the next best. Smoke species add. Of nodes, a cell gets the mean
 * of its eight. Where a mesh's smoke is lost or damaged and has no other source, it is an error.
 *
 * Output 1, Geometry, is a vtkPolyData with fronts towards the gas: rectangles of obstructions and
 * of the outer boundaries of the meshes that are not open, and triangles of complex geometry
 * (GEOM). Cell arrays:
 *  - `Reflectance` (float, 3 components, 0 to 1): linear red, green, blue from the sRGB colour of
 * the obstruction, else from the surface's texture, an image beside the index, or its colour.
 *  - `SurfaceName` (string): FDS's name of the surface.
 *
 * Output 2, Devices, is a vtkTable with a column `Time` [s] and one a device; its field data name
 * the columns' `Units` and the devices' `Position` [m].
 *
 * Output 3, Slices, is a vtkPartitionedDataSetCollection with a flat vtkRectilinearGrid for each
 * 2-D slice of each mesh whose file is there, with an array named after the quantity: on the points
 * of a node-centred slice, on the cells of a cell-centred one, at the cells' centres.
 *
 * Output 4, Boundary, is a vtkPartitionedDataSetCollection with a vtkPolyData for each boundary
 * file
 * (.bf) that is there: the walls of one mesh as they are at that time, with an array named after
 * the quantity, on the points or, where FDS wrote cells, on the cells.
 *
 * The time steps are the frame times of all meshes. A requested time gives the nearest frame, the
 * earlier of two equally near, or is interpolated; obstructions are shown as they are at that time.
 *
 * Meshes are read by several threads. In parallel runs each process reads its share of the meshes;
 * filters that ask for the whole, as the light field does, get it whole.
 */

#ifndef vtkFDSSmokeReader_h
#define vtkFDSSmokeReader_h

#include "SmokeReadersModule.h" // for the export macro
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

namespace smokevis
{
class FDSFileBlocks;
}

class SMOKEREADERS_EXPORT vtkFDSSmokeReader : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkFDSSmokeReader* New();
  vtkTypeMacro(vtkFDSSmokeReader, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Path of the run's index, CHID.smv. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Reads the index and the frame times anew at the next update: a run may have written more.
   */
  void Refresh();

  ///@{
  /**
   * Obstructions whose opacity (alpha of their own colour, else of their surface, 0 to 1; 0 for
   * ones that are invisible in Smokeview) is below this let light through: they are left out of the
   * geometry. 0 keeps all. Range 0 to 1, default 0.5. Their cells hold no smoke in any case.
   */
  void SetTransparencyThreshold(double value);
  vtkGetMacro(TransparencyThreshold, double);
  ///@}

  ///@{
  /**
   * Where the extinction coefficient is to come from; the run must have written it. Default
   * AUTOMATIC_SOURCE, the best there is in the order above.
   */
  enum ExtinctionSources
  {
    AUTOMATIC_SOURCE,
    EXTINCTION_SLICES,
    OPTICAL_DENSITY_SLICES,
    DENSITY_SLICES,
    MASS_FRACTION_SLICES,
    DENSITY_SMOKE3D,
    PLOT3D,
    VISIBILITY_SLICES,
    OPACITY_SMOKE3D
  };
  vtkSetClampMacro(ExtinctionSource, int, AUTOMATIC_SOURCE, OPACITY_SMOKE3D);
  vtkGetMacro(ExtinctionSource, int);
  ///@}

  ///@{
  /**
   * Mass extinction coefficient Km of the smoke at 633 nm [m2/kg] to take instead of the run's own;
   * whatever K comes from is scaled to it. 0: the run's own. Range 0 to 100000, default 0.
   */
  void SetMassExtinctionCoefficient(double value);
  vtkGetMacro(MassExtinctionCoefficient, double);
  ///@}

  ///@{
  /**
   * Visibility factor C [1] with which the run computed VISIBILITY, S = C/K (its
   * VISIBILITY_FACTOR). Used only where VISIBILITY is all there is. Range 0.01 to 100, default 3.
   */
  void SetVisibilityFactor(double value);
  vtkGetMacro(VisibilityFactor, double);
  ///@}

  ///@{
  /**
   * Single-scattering albedo of the smoke. It is put into the field data, from where the light
   * field takes it, and says how much of the extinction emits light in flames. Below 0: the run's
   * own, else 0.3. Range -1 to 1, default -1.
   */
  void SetAlbedo(double value);
  vtkGetMacro(Albedo, double);
  ///@}

  ///@{
  /**
   * What is shown at a time between two frames: the nearest one, or values linear in between.
   * Default NEAREST_FRAME.
   */
  enum TimeInterpolations
  {
    NEAREST_FRAME,
    LINEAR_IN_TIME
  };
  vtkSetClampMacro(TimeInterpolation, int, NEAREST_FRAME, LINEAR_IN_TIME);
  vtkGetMacro(TimeInterpolation, int);
  ///@}

  ///@{
  /**
   * The light of flames, in `EmittedLuminance`, where the run wrote in 3-D what the model needs.
   * FLAMES_BY_HEAT_RELEASE spreads LuminousEfficacy times the heat release rate over the burning
   * cells, in proportion to HRRPUV; of a cell of volume V come 4 pi K (1 - albedo) L_emit V lumens.
   * FLAMES_BY_TEMPERATURE lets the smoke glow like a black body of its (flame) temperature; cells
   * are far larger than flames are thick, and their mean temperature makes that too faint by orders
   * of magnitude unless the mesh resolves the flames. Default FLAMES_BY_HEAT_RELEASE.
   */
  enum FlameModels
  {
    NO_FLAMES,
    FLAMES_BY_HEAT_RELEASE,
    FLAMES_BY_TEMPERATURE
  };
  vtkSetClampMacro(FlameModel, int, NO_FLAMES, FLAMES_BY_TEMPERATURE);
  vtkGetMacro(FlameModel, int);
  ///@}

  ///@{
  /**
   * Light per heat release of flames [lm/W]. Soot that radiates a fraction X of the heat release at
   * the temperature T, with an emissivity that falls as 1/wavelength, gives X times 0.019, 0.061,
   * 0.16, 0.36, 0.72 lm/W at 1200, 1300, 1400, 1500, 1600 K. Pool fires of plastics and sooty
   * liquids radiate X = 0.3 to 0.4 at 1200 to 1400 K (Markstein, Radiative properties of plastics
   * fires, Symp. Combust. 17, 1979; de Ris, Fire radiation, ibid.), that is 0.006 to 0.06 lm/W,
   * wood and furniture up to 1500 K, 0.13 lm/W; a candle has 0.16 lm/W. Range 0 to 100, default
   * 0.05.
   */
  void SetLuminousEfficacy(double value);
  vtkGetMacro(LuminousEfficacy, double);
  ///@}

  ///@{
  /**
   * Whether the output Slices is read. Default on.
   */
  vtkSetMacro(ReadPlaneSlices, bool);
  vtkGetMacro(ReadPlaneSlices, bool);
  vtkBooleanMacro(ReadPlaneSlices, bool);
  ///@}

  ///@{
  /**
   * Whether the output Boundary is read. Default on.
   */
  vtkSetMacro(ReadBoundary, bool);
  vtkGetMacro(ReadBoundary, bool);
  vtkBooleanMacro(ReadBoundary, bool);
  ///@}

protected:
  vtkFDSSmokeReader();
  ~vtkFDSSmokeReader() override;

  int ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int port, vtkMTimeType* mtime) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkFDSSmokeReader(const vtkFDSSmokeReader&) = delete;
  void operator=(const vtkFDSSmokeReader&) = delete;

  /// Opens the run; false where that fails, which is then said, but once only.
  bool LoadRun();
  void Warn(const std::vector<std::string>& warnings);

  /// Warns, once a run, of files that it has not written to their ends.
  void WarnOfGrowth(vtkInformation* outInfo);
  double SceneTime(vtkInformation* outInfo) const;
  void ReadPort(int port, vtkInformation* outInfo);
  void ReadSmoke(vtkInformation* outInfo);
  void ReadGeometry(vtkInformation* outInfo);
  void ReadDevices(vtkInformation* outInfo);
  /// Reads an output with a block a file, of which missing ones make empty blocks.
  void ReadBlocks(vtkInformation* outInfo, const char* what, smokevis::FDSFileBlocks& files);

  char* FileName = nullptr;
  double TransparencyThreshold = 0.5;
  int ExtinctionSource = AUTOMATIC_SOURCE;
  double MassExtinctionCoefficient = 0.0;
  double VisibilityFactor = 3.0;
  double Albedo = -1.0;
  int TimeInterpolation = NEAREST_FRAME;
  int FlameModel = FLAMES_BY_HEAT_RELEASE;
  double LuminousEfficacy = 0.05;
  bool ReadPlaneSlices = true;
  bool ReadBoundary = true;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
