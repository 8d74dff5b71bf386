// What is drawn on signs: block letters and a pictogram, all our own drawing.
#pragma once

#include "PlateFigure.h"

#include <string>

namespace smokevis
{

/// A figure, its lower left corner at 0.
struct SignFigure
{
  std::vector<FigurePolygon> Polygons;
  double Width = 0.0;
  double Height = 1.0;
};

/// Text in block letters of height 1. Their stroke is an eighth of the height, and so is the gap
/// between letters: UL 924 asks for strokes of 3/4 inch, gaps of 3/8 inch and a width of 2 inches
/// (but for the I) in letters 6 inches high. Small letters count as capitals. Throws Error for
/// text without a letter and for characters other than A to Z, 0 to 9, blank, and - . / & ! ' +.
/// @param where what the text belongs to, for error messages
SignFigure TextFigure(const std::string& text, const std::string& where);

/// A man who runs through a door, in the spirit of the emergency exit of ISO 7010, E001; as wide as
/// it is high.
SignFigure RunningManFigure();

} // namespace smokevis
