// What the horizontal slices of an FDS run hold at given points.
#pragma once

#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;

namespace smokevis
{

/// Values of a quantity at the points of an image, from horizontal slices near its height: of each
/// point from the nearest slice that reaches it, interpolated where the slice has values at points;
/// NaN where none does, and where the value is not positive, as FDS leaves it in solids.
/// @param slices collection of flat grids with an array whose name ends with the quantity
/// @param tolerance how far above or below a slice may lie [m]
std::vector<float> SampleSlices(
  vtkDataObject* slices, const std::string& quantity, vtkImageData* image, double tolerance);

} // namespace smokevis
