/**
 * @class   vtkCADReader
 * @brief   reads a building's geometry from a CAD file
 *
 * Reads STEP and IGES (Open CASCADE, which turns curved faces into triangles to the tolerances
 * below), and OBJ, STL, PLY, glTF, COLLADA, FBX, 3DS, DXF and IFC (assimp). The format is told by
 * the extension of the file's name. Output is in metres with z up.
 *
 * Output 0, Surfaces, is a vtkPolyData of triangles, in double precision, with the cell arrays
 *  - `Reflectance` (float, 3 components, 0 to 1): linear red, green and blue;
 *  - `Material`, `Object` (string): names as the file has them; B-rep colours without a material
 *    are called after their sRGB value, such as #CCB399;
 *  - `MaterialId`, `ObjectId` (int): positions in the field data `MaterialNames` and
 *    `ObjectNames`.
 *
 * Output 1, Emitters, holds the triangles to which the material table gives a luminance or a sign,
 * which are then missing from output 0, with these arrays too:
 *  - `Luminance` (double, 1 or 3 components): of the front [cd/m2], the side from which the corners
 *    run anticlockwise, which of solids is the outside;
 *  - `SignId` (int): -1 for a lamp;
 *  - `SignName` (string): from the table, else "Sign <id>", "Lamp" for lamps.
 *
 * Field data of both: `Format`, `UnitScale` (length of one unit of the file [m]), `UnitSource`,
 * `UpAxis`, `UpSource` (who said so: the file, the format's default or the property),
 * `ModelBounds` (xmin, xmax, ... of both outputs together [m]), `Triangles`, `DegenerateTriangles`,
 * `TransparentTriangles`, `DroppedTriangles` (kept; without area; left out as transparent; left out
 * by the table), `MaterialNames`, `ObjectNames`, `ObjectGroups` (the assemblies, groups and kinds
 * that the object belongs to, separated by slashes).
 *
 * Each process reads the whole file.
 *
 * @par Reflectance
 * A base or diffuse colour is the reflectance. Its numbers are taken for sRGB and made linear (IEC
 * 61966-2-1), but for glTF, whose colours are linear by its specification. Colours of corners count
 * where a material has none, as their mean over the triangle. An image counts as the mean of its
 * pixels, times the colour in glTF and OBJ.
 *
 * @par Material table
 * A CSV file whose first line names the columns, or a .json file with an array of objects of the
 * same keys: `name` (needed; the name of a material, object or group of objects, with * and ?, case
 * does not matter), `reflectance` (one number or three, 0 to 1), `luminance` (one number or three
 * [cd/m2]), `sign` (id of the sign, -1 for a lamp), `sign_name`, `drop` (yes or no). Several rows
 * may match; later ones override earlier ones. Triangles with a sign and no luminance are its unlit
 * parts.
 */
#ifndef vtkCADReader_h
#define vtkCADReader_h

#include "SmokeReadersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr

class SMOKEREADERS_EXPORT vtkCADReader : public vtkPolyDataAlgorithm
{
public:
  static vtkCADReader* New();
  vtkTypeMacro(vtkCADReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum UpAxes
  {
    UP_AUTOMATIC = 0,
    UP_X = 1,
    UP_Y = 2,
    UP_Z = 3
  };

  enum ColorSpaces
  {
    COLORS_AUTOMATIC = 0,
    COLORS_SRGB = 1,
    COLORS_LINEAR = 2
  };

  ///@{
  /**
   * Path of the CAD file. No default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Path of the material table, CSV or JSON; blank for none. Default: none.
   */
  vtkSetFilePathMacro(MaterialTable);
  vtkGetFilePathMacro(MaterialTable);
  ///@}

  ///@{
  /**
   * Length of one unit of the file [m], such as 0.001 for millimetres. 0: what the file says (STEP,
   * IGES, COLLADA, FBX, DXF, IFC), else 1 m (OBJ, STL, PLY, glTF, 3DS). Range from 0, default 0.
   */
  vtkSetMacro(UnitScale, double);
  vtkGetMacro(UnitScale, double);
  ///@}

  ///@{
  /**
   * Axis of the file that points up. Automatic: what the file says (COLLADA, FBX), else y for OBJ
   * and glTF and z for all others. Range 0 to 3, default UP_AUTOMATIC.
   */
  vtkSetClampMacro(UpAxis, int, UP_AUTOMATIC, UP_Z);
  vtkGetMacro(UpAxis, int);
  ///@}

  ///@{
  /**
   * Where to move the model, after turning it [m]. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Translation, double);
  vtkGetVector3Macro(Translation, double);
  ///@}

  ///@{
  /**
   * Angles by which to turn the model with z up about x, y and z through the origin [degrees],
   * first about y, then x, then z as in ParaView's Transform. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Rotation, double);
  vtkGetVector3Macro(Rotation, double);
  ///@}

  ///@{
  /**
   * Largest distance between a curved face of STEP or IGES and its triangles [m]. Range from 1e-6,
   * default 0.005.
   */
  vtkSetMacro(LinearTolerance, double);
  vtkGetMacro(LinearTolerance, double);
  ///@}

  ///@{
  /**
   * Largest angle between neighbouring triangles of a curved face of STEP or IGES [degrees], but
   * for edges shorter than a tenth of LinearTolerance. Range 0.5 to 90, default 15.
   */
  vtkSetMacro(AngularTolerance, double);
  vtkGetMacro(AngularTolerance, double);
  ///@}

  ///@{
  /**
   * What the numbers of the file's colours mean. Automatic: linear in glTF, else sRGB. Range 0 to
   * 2, default COLORS_AUTOMATIC.
   */
  vtkSetClampMacro(ColorSpace, int, COLORS_AUTOMATIC, COLORS_LINEAR);
  vtkGetMacro(ColorSpace, int);
  ///@}

  ///@{
  /**
   * Reflectance of materials without a colour [1]. Range 0 to 1, default 0.5.
   */
  void SetDefaultReflectance(double value);
  vtkGetMacro(DefaultReflectance, double);
  ///@}

  ///@{
  /**
   * Materials whose opacity is below this let light through: they are left out. 0 keeps all. The
   * material table can keep single ones by drop = no. Range 0 to 1, default 0.5.
   */
  void SetTransparencyThreshold(double value);
  vtkGetMacro(TransparencyThreshold, double);
  ///@}

protected:
  vtkCADReader();
  ~vtkCADReader() override;

  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int port, vtkMTimeType* mtime) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCADReader(const vtkCADReader&) = delete;
  void operator=(const vtkCADReader&) = delete;

  /// Throws where a property is not a finite number.
  void CheckProperties() const;

  /// Reads the file where it or a property that counts for reading changed.
  void LoadModel();

  /// Fills the outputs from the model and the material table.
  void Build(vtkPolyData& surfaces, vtkPolyData& emitters);

  char* FileName = nullptr;
  char* MaterialTable = nullptr;
  double UnitScale = 0.0;
  int UpAxis = UP_AUTOMATIC;
  double Translation[3] = {0.0, 0.0, 0.0};
  double Rotation[3] = {0.0, 0.0, 0.0};
  double LinearTolerance = 0.005;
  double AngularTolerance = 15.0;
  int ColorSpace = COLORS_AUTOMATIC;
  double DefaultReflectance = 0.5;
  double TransparencyThreshold = 0.5;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
