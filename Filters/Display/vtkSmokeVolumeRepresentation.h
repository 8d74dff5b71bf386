/**
 * @class vtkSmokeVolumeRepresentation
 * @brief Draws smoke as the volume that it is, and the outlines of its meshes.
 *
 * A line of sight through smoke lets exp(-integral of K ds) of the light behind pass, K the
 * extinction coefficient; what it hides has the colour of the smoke. This is what the eye would see
 * of smoke that is lit evenly: the light of signs and lamps that it scatters is in
 * vtkVisibilityImage alone.
 *
 * The input is any data; smoke are images and rectilinear grids in it, not turned, with the array
 * `Extinction` [1/m] on cells or points: one mesh or many, side by side or over each other, of even
 * or stretched cells. Where they overlap the one with the smaller cells counts, as in the light
 * field. Volume mappers draw meshes one by one, with seams and twice where they overlap; so all are
 * brought into one image of even cells as large as the finest mesh's, in which a cell has the mean
 * of what it covers. Whatever else the input has is shown by its outline.
 *
 * Where ParaView draws is its own choice, as for surfaces: on the client, to which the image is
 * brought, or on the server, of which each process draws a slab.
 */
#ifndef vtkSmokeVolumeRepresentation_h
#define vtkSmokeVolumeRepresentation_h

#include "SmokeDisplayModule.h"
#include "vtkNew.h"
#include "vtkVolumeRepresentation.h"

#include <memory>

class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkSmartVolumeMapper;

class SMOKEDISPLAY_EXPORT vtkSmokeVolumeRepresentation : public vtkVolumeRepresentation
{
public:
  static vtkSmokeVolumeRepresentation* New();
  vtkTypeMacro(vtkSmokeVolumeRepresentation, vtkVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey* requestType, vtkInformation* inInfo,
    vtkInformation* outInfo) override;

  void SetVisibility(bool visible) override;

  ///@{
  /**
   * Colour of the smoke: red, green, blue from 0 to 1. Default 0.2, 0.2, 0.2, a dark grey.
   */
  vtkSetVector3Macro(SmokeColor, double);
  vtkGetVector3Macro(SmokeColor, double);
  ///@}

  ///@{
  /**
   * How many times as thick as it is the smoke is drawn, to see thin smoke from far away or through
   * dense smoke. No unit; range 0 to 1e6, default 1: as it is.
   */
  vtkSetClampMacro(ExtinctionFactor, double, 0.0, 1e6);
  vtkGetMacro(ExtinctionFactor, double);
  ///@}

  ///@{
  /**
   * How many cells the image of the smoke has at most, of 4 bytes each. Range 1000 to 1e9, default
   * 4 million.
   */
  void SetMaximumNumberOfCells(int most);
  vtkGetMacro(MaximumNumberOfCells, int);
  ///@}

  ///@{
  /**
   * Of the outline: colour (red, green, blue from 0 to 1) and width [pixels].
   */
  void SetOutlineColor(double red, double green, double blue);
  void SetOutlineWidth(double width);
  ///@}

  ///@{
  /**
   * Of the smoke and the outline.
   */
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  ///@}

protected:
  vtkSmokeVolumeRepresentation();
  ~vtkSmokeVolumeRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkSmokeVolumeRepresentation(const vtkSmokeVolumeRepresentation&) = delete;
  void operator=(const vtkSmokeVolumeRepresentation&) = delete;

  void MakeImage(vtkDataObject* input);
  void ShowImage(vtkImageData* image, vtkPolyData* outline);

  double SmokeColor[3] = {0.2, 0.2, 0.2};
  double ExtinctionFactor = 1.0;
  int MaximumNumberOfCells = 4000000;

  struct Internals;
  const std::unique_ptr<Internals> Parts;
};

#endif
