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
 * of any sign where there is no target; `SignIds`, int, the id of the sign seen, -1: none. A sign
 * that is small in the picture is also marked in the pixel that holds its middle.
 *
 * Signs and lamps that are less than some 16 pixels wide, or than one, count in each pixel with the
 * exact area that they fill of it, so that their light does not depend on where they fall.
 *
 * Second output: the photograph that a camera takes of it, the same points with the unsigned char
 * array `Photograph`, one component or three with RGB, ready for a PNG file.
 *
 * Field data, one double each, measured over the front of the target sign (without a target: the
 * sign that covers the most pixels) at the observer's acuity, not at the pixels of this image:
 * `Contrast` (standard deviation over mean), `PerceivedContrast` (standard deviation over mean plus
 * DarkLuminance) with their standard errors by the light field's noise, `ContrastError` and
 * `PerceivedContrastError`, and by how uneven the smoke is between the places of the plate that are
 * looked at, `ContrastDivisionError` and `PerceivedContrastDivisionError`; `WebberContrast`,
 * `UL924Contrast`, `MeanLuminance`, `MeanLuminanceError`, `LitLuminance`, `UnlitLuminance` [cd/m2],
 * `VisibleFraction`, `OpticalDepthToSign`, `MeasuredSign` (its id, -1: none), and
 * `SensorIlluminance` [lx], the sign's mean illuminance on the sensor as ISO 12232 has it,
 * 0.65 L / (FNumber (1 + Magnification))^2, in which 0.65 is pi/4 times a lens's transmittance of
 * 0.9, vignetting of 0.98 and cos^4 of 10 degrees; `VisibleProbability`, the share of observers who
 * see the sign, thresholds of 0.2 +- 0.04 being normally distributed (a plate whose luminance
 * varies for another reason than its pattern, such as a lamp at its side, has a contrast as well
 * and counts as seen; WebberContrast and UL924Contrast compare its lit and unlit parts alone);
 * `EyeLuminance` [cd/m2], DarkLuminance and what adaptation and glare add. The camera:
 * `CameraPosition`, `CameraForward`, `CameraUp`, and `CameraWindow`, the tangents of the angles to
 * the left, right, lower and upper edge. Of the lens: `ImageDistance` [mm], `ObjectDistance` [m,
 * infinite where it is focused far away] and `Magnification`; of the photograph: `ShutterTime` [s].
 * What was done, how often and why: `WorkReportWhat`, `WorkReportCount`, `WorkReportWhy`; their
 * last rows are the seconds that each process took to trace its pixels.
 */
#ifndef vtkVisibilityImage_h
#define vtkVisibilityImage_h

#include "SmokeFiltersModule.h"
#include <vtkImageAlgorithm.h>

#include <memory>
#include <vector>

class vtkStringArray;

namespace smokevis
{
class Agreement;
struct SignMeasurement;
} // namespace smokevis

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
   * The target sign by an entry of GetSignList, "id: name", or by its name alone; "(by id)" or
   * nothing: TargetSign decides. Default: "(by id)".
   */
  vtkSetStringMacro(TargetSignName);
  vtkGetStringMacro(TargetSignName);
  ///@}

  /**
   * What TargetSignName may be for the light field as it was last computed: "(by id)", then
   * "id: name" for each of its signs.
   */
  vtkStringArray* GetSignList();

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
   * Focal length [mm], above 0. Where there is a target sign the picture is cut to its plate, and
   * the focal length counts for blur and photograph only. Default: 50.
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
   * Focal length over aperture, from 0.1. Counts for photograph, blur and SensorIlluminance;
   * luminance does not depend on it. Default: 2.8.
   */
  vtkSetMacro(FNumber, double);
  vtkGetMacro(FNumber, double);
  ///@}

  enum CameraModels
  {
    CUSTOM = 0,
    CANON_EOS_10D = 1
  };

  ///@{
  /**
   * A camera whose sensor and pixels take the place of SensorSize and ImageSize. CUSTOM: none;
   * CANON_EOS_10D: 22.7 x 15.1 mm and 3072 x 2048 pixels, as in Zhang and Rubini's experiment.
   * Default: CUSTOM.
   */
  vtkSetClampMacro(CameraModel, int, CUSTOM, CANON_EOS_10D);
  vtkGetMacro(CameraModel, int);
  ///@}

  ///@{
  /**
   * Pixels of the camera model along each side that are merged into one of the image, from 1.
   * Default: 8.
   */
  vtkSetMacro(PixelBinning, int);
  vtkGetMacro(PixelBinning, int);
  ///@}

  ///@{
  /**
   * Distance from the sensor to the plane in focus [m], at least four focal lengths; the lens then
   * stands further from the sensor than its focal length (Zhang and Rubini, eq. 8). 0: focused on
   * infinity. Default: 0.
   */
  vtkSetMacro(FocusDistance, double);
  vtkGetMacro(FocusDistance, double);
  ///@}

  ///@{
  /**
   * Whether what lies outside the plane in focus is blurred by the lens's aperture, FocalLength
   * over FNumber. Takes 65 times as long. Default: 0.
   */
  vtkSetMacro(LensBlur, bool);
  vtkGetMacro(LensBlur, bool);
  vtkBooleanMacro(LensBlur, bool);
  ///@}

  ///@{
  /**
   * Exposure time of the photograph [s]; 0: what a meter that averages over the picture asks for,
   * within 1/8000 and 30 s. Default: 0.
   */
  vtkSetMacro(ExposureTime, double);
  vtkGetMacro(ExposureTime, double);
  ///@}

  ///@{
  /**
   * Speed of the photograph, ISO 12232, above 0. Default: 100.
   */
  vtkSetMacro(ISO, double);
  vtkGetMacro(ISO, double);
  ///@}

  ///@{
  /**
   * CSV file with the camera's response, columns exposure [lx s at ISO 100] and pixel_value (0 to
   * 255); none: a film-like curve. Default: none.
   */
  vtkSetFilePathMacro(ResponseFile);
  vtkGetFilePathMacro(ResponseFile);
  ///@}

  ///@{
  /**
   * Standard deviation of the photograph's read noise as a share of the exposure that saturates the
   * sensor, from 0. Default: 0.
   */
  vtkSetMacro(ReadNoise, double);
  vtkGetMacro(ReadNoise, double);
  ///@}

  ///@{
  /**
   * Start of the random numbers of the read noise. Default: 1.
   */
  vtkSetMacro(NoiseSeed, int);
  vtkGetMacro(NoiseSeed, int);
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
   * Free border around a target sign, as a share of its size on each side, 0 to 1000. Default: 0.
   */
  vtkSetMacro(Margin, double);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /**
   * Equivalent luminance of the observer's own noise [cd/m2], 0 to 1e12. Default: 0.1.
   */
  vtkSetMacro(DarkLuminance, double);
  vtkGetMacro(DarkLuminance, double);
  ///@}

  ///@{
  /**
   * Smallest angle that the observer resolves [minutes of arc], 0 to 10800; finer detail is
   * averaged. Default: 1.
   */
  vtkSetMacro(Acuity, double);
  vtkGetMacro(Acuity, double);
  ///@}

  ///@{
  /**
   * Luminance that the eye was adapted to before it came here, such as that of a lit room [cd/m2],
   * from 0; 0: adapted to the dark. It raises the eye's own noise by 0.05 L (1.9 + t)^-1.4, the
   * adaptation curve of CIE 88, t being AdaptationTime. Default: 0.
   */
  vtkSetMacro(AdaptationLuminance, double);
  vtkGetMacro(AdaptationLuminance, double);
  ///@}

  ///@{
  /**
   * Time since the eye left the place that it was adapted to [s], from 0. Default: 0.
   */
  vtkSetMacro(AdaptationTime, double);
  vtkGetMacro(AdaptationTime, double);
  ///@}

  ///@{
  /**
   * Whether lamps, other signs and flames in open view veil the sign that the eye looks at, by the
   * general equation for disability glare of CIE 146 (2002). Default: 0.
   */
  vtkSetMacro(Glare, bool);
  vtkGetMacro(Glare, bool);
  vtkBooleanMacro(Glare, bool);
  ///@}

  ///@{
  /**
   * Age of the observer, for glare [years], from 0 to 100. Default: 35.
   */
  vtkSetMacro(ObserverAge, double);
  vtkGetMacro(ObserverAge, double);
  ///@}

protected:
  vtkVisibilityImage();
  ~vtkVisibilityImage() override;

  int ComputePipelineMTime(vtkInformation*, vtkInformationVector**, vtkInformationVector*, int,
    vtkMTimeType* mtime) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkVisibilityImage(const vtkVisibilityImage&) = delete;
  void operator=(const vtkVisibilityImage&) = delete;

  void CheckProperties() const;
  void UseModel(double sensor[2], int size[2]) const;
  struct Shot;

  Shot Prepare(vtkDataObject* input);
  /// Takes and develops a shot, together with all processes of a parallel run.
  void Trace(vtkDataObject* input, vtkImageData* output, vtkImageData* photograph);
  void AddProperties(smokevis::Agreement& agreement) const;
  /// Returns what was measured of the sign.
  smokevis::SignMeasurement Develop(
    const Shot& shot, vtkImageData* output, vtkImageData* photograph);
  /// @param seconds that each process has worked
  void Report(const Shot& shot, const smokevis::SignMeasurement& sign,
    const std::vector<double>& seconds, vtkImageData& output) const;

  double CameraPosition[3] = {0.0, 0.0, 1.7};
  int TargetSign = -1;
  char* TargetSignName = nullptr;
  double CameraFocalPoint[3] = {1.0, 0.0, 1.7};
  double CameraViewUp[3] = {0.0, 0.0, 1.0};
  double FocalLength = 50.0;
  double SensorSize[2] = {36.0, 24.0};
  double FNumber = 2.8;
  int CameraModel = CUSTOM;
  int PixelBinning = 8;
  double FocusDistance = 0.0;
  bool LensBlur = false;
  double ExposureTime = 0.0;
  double ISO = 100.0;
  char* ResponseFile = nullptr;
  double ReadNoise = 0.0;
  int NoiseSeed = 1;
  int ImageSize[2] = {256, 128};
  double Margin = 0.0;
  double DarkLuminance = 0.1;
  double Acuity = 1.0;
  double AdaptationLuminance = 0.0;
  double AdaptationTime = 0.0;
  bool Glare = false;
  double ObserverAge = 35.0;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
};

#endif
