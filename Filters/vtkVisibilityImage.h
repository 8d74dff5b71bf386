/**
 * @class   vtkVisibilityImage
 * @brief   what an eye or a camera in the smoke sees, and how well a sign stands out
 *
 * Input: the output of vtkSmokeLightField, fresh or read from a file. Output: an image of ImageSize
 * points, spacing 1, with the point arrays
 * - `Luminance`, float [cd/m2], and its standard error `LuminanceError`; `LuminanceRGB`, 3
 * components, where the light field has three bands;
 * - `DirectLuminance`, float, what is left of the light of surfaces and signs; `VeilLuminance`,
 * float, what the smoke adds; `OpticalDepth`, float, to the end of the ray (of the green band with
 * RGB);
 * - `SignMask`, unsigned char, 1 where the middle of a pixel sees the front of the target sign, or
 * of any sign where there is no target; `SignIds`, int, the id of the sign seen, -1: none.
 *
 * Field data, one double each, measured over the front of the target sign (without a target: the
 * sign that covers the most pixels) at the observer's acuity, not at the pixels of this image:
 * `Contrast` (standard deviation over mean), `PerceivedContrast` (standard deviation over mean plus
 * DarkLuminance) with `ContrastError` and `PerceivedContrastError`, `WebberContrast`,
 * `UL924Contrast`, `MeanLuminance`, `MeanLuminanceError`, `LitLuminance`, `UnlitLuminance` [cd/m2],
 * `VisibleFraction`, `OpticalDepthToSign`, `MeasuredSign` (its id, -1: none), and
 * `SensorIlluminance` [lx], the sign's mean illuminance on the sensor, pi L / (4 FNumber^2).
 * The camera: `CameraPosition`, `CameraForward`, `CameraUp`, and `CameraWindow`, the tangents of
 * the angles to the left, right, lower and upper edge.
 */
#ifndef vtkVisibilityImage_h
#define vtkVisibilityImage_h

#include "SmokeFiltersModule.h"
#include <vtkImageAlgorithm.h>

#include <memory>

class SMOKEFILTERS_EXPORT vtkVisibilityImage : public vtkImageAlgorithm
{
public:
  static vtkVisibilityImage* New();
  vtkTypeMacro(vtkVisibilityImage, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the eye or camera is [m]. Default: (0, 0, 1.7).
   */
  vtkSetVector3Macro(CameraPosition, double);
  vtkGetVector3Macro(CameraPosition, double);
  ///@}

  ///@{
  /**
   * Id of the sign whose plate is to fill the picture, or -1 to look at CameraFocalPoint.
   * Default: -1.
   */
  vtkSetMacro(TargetSign, int);
  vtkGetMacro(TargetSign, int);
  ///@}

  ///@{
  /**
   * Point that the camera looks at [m], where there is no target sign. Default: (1, 0, 1.7).
   */
  vtkSetVector3Macro(CameraFocalPoint, double);
  vtkGetVector3Macro(CameraFocalPoint, double);
  ///@}

  ///@{
  /**
   * Direction that is up in the picture. Default: (0, 0, 1).
   */
  vtkSetVector3Macro(CameraViewUp, double);
  vtkGetVector3Macro(CameraViewUp, double);
  ///@}

  ///@{
  /**
   * Focal length [mm], above 0; counts where there is no target sign. Default: 50.
   */
  vtkSetMacro(FocalLength, double);
  vtkGetMacro(FocalLength, double);
  ///@}

  ///@{
  /**
   * Width and height of the sensor [mm], above 0; counts where there is no target sign. The picture
   * is the largest middle part of it that has the proportions of ImageSize. Default: (36, 24).
   */
  vtkSetVector2Macro(SensorSize, double);
  vtkGetVector2Macro(SensorSize, double);
  ///@}

  ///@{
  /**
   * Focal length over aperture, above 0. Scales SensorIlluminance only; luminance does not depend
   * on it. Default: 2.8.
   */
  vtkSetMacro(FNumber, double);
  vtkGetMacro(FNumber, double);
  ///@}

  ///@{
  /**
   * Width and height of the image in pixels, from 1, at most 100 million together.
   * Default: (256, 128).
   */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  ///@}

  ///@{
  /**
   * Free border around a target sign, as a share of its size on each side, from 0. Default: 0.
   */
  vtkSetMacro(Margin, double);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /**
   * Equivalent luminance of the observer's own noise [cd/m2], from 0. Default: 0.1.
   */
  vtkSetMacro(DarkLuminance, double);
  vtkGetMacro(DarkLuminance, double);
  ///@}

  ///@{
  /**
   * Smallest angle that the observer resolves [minutes of arc], from 0; finer detail is averaged.
   * Default: 1.
   */
  vtkSetMacro(Acuity, double);
  vtkGetMacro(Acuity, double);
  ///@}

protected:
  vtkVisibilityImage();
  ~vtkVisibilityImage() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkVisibilityImage(const vtkVisibilityImage&) = delete;
  void operator=(const vtkVisibilityImage&) = delete;

  void CheckProperties() const;
  void Trace(vtkDataObject* input, vtkImageData* output);

  double CameraPosition[3] = {0.0, 0.0, 1.7};
  int TargetSign = -1;
  double CameraFocalPoint[3] = {1.0, 0.0, 1.7};
  double CameraViewUp[3] = {0.0, 0.0, 1.0};
  double FocalLength = 50.0;
  double SensorSize[2] = {36.0, 24.0};
  double FNumber = 2.8;
  int ImageSize[2] = {256, 128};
  double Margin = 0.0;
  double DarkLuminance = 0.1;
  double Acuity = 1.0;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
