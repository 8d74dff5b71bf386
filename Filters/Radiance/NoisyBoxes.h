// Where more lines should go, by what those of a sweep brought of the noise.
#pragma once

#include "Box.h"
#include "Types.h"

#include <cstddef>
#include <vector>

namespace smokevis
{

/// A line of a sweep, and what it brought of the variance that is to be brought down.
struct SurveyedLine
{
  /// Where it enters the scene, from the lower corner of the box around all lines [m], and where it
  /// leads.
  glm::vec3 Origin, Direction;
  /// Density that it was drawn with [1/m2], of all kinds of lines together.
  float Density;
  /// Square of what it brought, in whatever unit.
  float Square;
};

/// A box that further lines are to lead through.
struct NoisyBox
{
  Box Bounds;
  /// How many a sweep.
  double Lines = 0.0;
};

/// Boxes whose lines bring much more of the variance than they are many, such as flames, doors and
/// windows: the strongest first, eight at most, none that
/// does not bring the variance of as many lines down by a tenth, and none larger than a 32nd of the
/// scene's length that more than a tenth of the surveyed lines meet. With the share l of all lines
/// and the share v of the variance, a box should get sqrt((v / (1 - v)) / (l / (1 - l))) times its
/// lines, which leaves (sqrt(v l) + sqrt((1 - v) (1 - l)))^2 of variance times work: the least of
/// (1 - l + l x) times (1 - v + v / x). Half of the lines find a box, the other half has to confirm
/// it. All boxes together get as many lines as a sweep has at most: what lines bring is not all of
/// the noise, which smoke and surfaces send on.
/// @param scene box around all lines
/// @param count of all lines of a sweep, which the density is of
std::vector<NoisyBox> FindNoisyBoxes(
  const std::vector<SurveyedLine>& lines, const Box& scene, std::size_t count);

} // namespace smokevis
