// The walls that lie inside cells of the smoke.
#pragma once

#include "Triangle.h"

#include <compare>
#include <cstdint>
#include <vector>

namespace smokevis
{

class Medium;
class Scene;

/// Triangles of surfaces and plates, and the cells with smoke that they reach into. Walls in the
/// faces between cells reach into none.
class CellWalls
{
public:
  /// A triangle and a cell that it cuts.
  struct Meeting
  {
    std::int64_t Cell;
    /// Place of the triangle among the walls.
    std::size_t Wall;

    auto operator<=>(const Meeting&) const = default;
  };

  explicit CellWalls(const Scene& scene);

  /// Of cells in the order of their numbers.
  std::vector<Meeting> Meetings;
  std::vector<Triangle> Walls;

private:
  /// Long triangles are halved, so that the boxes around them hold few cells beside theirs.
  void Find(const Medium& smoke, const Triangle& corners);
};

} // namespace smokevis
