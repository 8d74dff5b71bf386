// CAD files and measures of models, for the tests of the CAD readers.
#pragma once

#include "CadModel.h"

#include <array>
#include <string>

namespace smokevis::test
{

/// The folder of the kiosk in every format.
inline const std::string Samples = SMOKEVIS_DATA_DIR "/CAD/";

/// Reads a file to the end.
CadModel Read(const std::string& fileName, const CadOptions& options = {});

/// The bytes of a file.
std::string Bytes(const std::string& fileName);

/// A text with the first `from`, which it must have, replaced.
std::string Replaced(std::string text, const std::string& from, const std::string& to);

/// Writes an upright cylinder of `radius` and `height` [m] on the origin as STEP.
/// @param unit unit of the file as Open CASCADE calls it: MM, M, INCH
void WriteStepCylinder(
  const std::string& fileName, const std::string& unit, double radius, double height);

/// Writes the kiosk of Data/CAD/README.md as STEP or IGES, by the file's extension, in millimetres:
/// an assembly Building of the three parts with their colours.
void WriteKiosk(const std::string& fileName);

/// Area and volume of the triangles of an object [m2, m3]; all objects where the name is blank.
struct Measure
{
  double Area = 0.0;
  /// Positive where fronts look outwards.
  double Volume = 0.0;
  std::array<double, 3> Low;
  std::array<double, 3> High;
};

Measure MeasureObject(const CadModel& model, const std::string& object = {});

} // namespace smokevis::test
