/**
 * @class vtkFDSSmokeReader
 * @brief Reads smoke, walls and device measurements of an FDS run.
 *
 * The input is the index that FDS writes for Smokeview, CHID.smv, with the files it names beside
 * it. Files that an output does not need may be missing. An output is read only when it is asked
 * for.
 *
 * Output 0, Smoke, is a vtkPartitionedDataSetCollection with one vtkRectilinearGrid a mesh, named
 * after the mesh, with two cell arrays:
 *  - `Extinction` (float, 1 component): extinction coefficient K at 633 nm [1/m]; 0 in solids and
 *    where the run wrote no data.
 *  - `Solid` (unsigned char, 1 component): 1 in cells inside an obstruction that is there at that
 *    time, else 0.
 *
 * Its field data, on the collection and on each grid, are `ExtinctionSource` (string: the
 * quantities and files used), `Albedo` (double, 0 to 1: single-scattering albedo that the run
 * used, 0.3 where the index does not say), `Time` (double: time of the frame [s]) and `CHID`
 * (string).
 *
 * K comes, on each mesh and for each smoke species, from the best of what the run wrote in 3-D:
 * slices of EXTINCTION COEFFICIENT, OPTICAL DENSITY, DENSITY of the species, each cell-centred
 * before node-centred; 8-bit smoke (.s3d, .s3dd) that holds density; Plot3D; slices of VISIBILITY;
 * 8-bit smoke that holds opacity. Parts of a mesh are completed by the next best. Smoke species
 * add. Of nodes, a cell gets the mean of its eight.
 *
 * Output 1, Geometry, is a vtkPolyData of rectangles with their front towards the gas: obstructions
 * and the outer boundaries of the meshes that are not open. Cell arrays:
 *  - `Reflectance` (float, 3 components, 0 to 1): linear red, green, blue from the sRGB colour of
 * the obstruction, else of the surface.
 *  - `SurfaceName` (string): FDS's name of the surface.
 *
 * Output 2, Devices, is a vtkTable with a column `Time` [s] and one a device; its field data name
 * the columns' `Units` and the devices' `Position` [m].
 *
 * The time steps are the frame times of all meshes. A requested time gives the nearest frame, the
 * earlier of two equally near; obstructions are shown as they are at that frame's time.
 */

#ifndef vtkFDSSmokeReader_h
#define vtkFDSSmokeReader_h

#include "SmokeReadersModule.h" // for the export macro
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkPolyData;

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

  ///@{
  /**
   * Obstructions whose opacity (alpha of their own colour, else of their surface, 0 to 1; 0 for
   * ones that are invisible in Smokeview) is below this let light through: they are left out of the
   * geometry. 0 keeps all. Range 0 to 1, default 0.5. Their cells hold no smoke in any case.
   */
  vtkSetClampMacro(TransparencyThreshold, double, 0.0, 1.0);
  vtkGetMacro(TransparencyThreshold, double);
  ///@}

  ///@{
  /**
   * Visibility factor C [1] with which the run computed VISIBILITY, S = C/K (its
   * VISIBILITY_FACTOR). Used only where VISIBILITY is all there is. Range 0.01 to 100, default 3.
   */
  vtkSetClampMacro(VisibilityFactor, double, 0.01, 100.0);
  vtkGetMacro(VisibilityFactor, double);
  ///@}

protected:
  vtkFDSSmokeReader();
  ~vtkFDSSmokeReader() override;

  int ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkFDSSmokeReader(const vtkFDSSmokeReader&) = delete;
  void operator=(const vtkFDSSmokeReader&) = delete;

  void LoadIndex();
  double SceneTime(vtkInformation* outInfo) const;
  void ReadSmoke(double time, vtkPartitionedDataSetCollection* output);
  void ReadGeometry(double time, vtkPolyData* output);

  char* FileName = nullptr;
  double TransparencyThreshold = 0.5;
  double VisibilityFactor = 3.0;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
