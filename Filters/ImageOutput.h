// The outputs of VisibilityImage: pixels, the figures of the sign, and the photograph.
#pragma once

#include "Camera.h"
#include "Contrast.h"
#include "ImageTracer.h"
#include "Photograph.h"

class vtkImageData;

namespace smokevis
{

/// Gives the image its size and its point arrays.
/// @param target sign that SignMask marks; below 0: all signs
void StorePixels(
  const TracedImage& traced, const int size[2], int bands, int target, vtkImageData& image);

/// Adds what was measured of a sign as field data.
/// @param sign its id, -1: none was in the picture
void StoreMeasurement(const SignMeasurement& result, int sign, vtkImageData& image);

/// Adds where the camera stood and what it saw as field data.
void StoreCamera(const Camera& camera, vtkImageData& image);

/// Adds the picture to an image that gets the structure and the field data of another one.
void StorePhotograph(const Photograph& taken, int bands, vtkImageData& like, vtkImageData& image);

} // namespace smokevis
