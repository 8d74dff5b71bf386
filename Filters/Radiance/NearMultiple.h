// How multiply scattered light varies inside cells right beside lights.
#pragma once

#include "IndirectLight.h"

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include <tbb/collaborative_call_once.h>

namespace smokevis
{

/// The smoke right before a light, lit by it, lights the smoke beside it: what is scattered twice
/// is steeper there than the means of neighbouring cells tell, and behind the plate there are none.
/// In cells where that matters the light varies as rays from a few places inside them gather it,
/// before a plate that cuts the cell and behind it; its mean stays what it is. A cell is looked at
/// when it is first asked for, and what is found depends on the light field alone, so that it does
/// not matter which thread does so.
class NearMultiple
{
public:
  /// Value() is let no further: this would be all of a cell's light in a twentieth of it, which
  /// what is scattered twice nowhere is.
  static constexpr double Largest = 20.0;

  /// @param light must outlive this
  explicit NearMultiple(const IndirectLight& light);

  /// Whether the light in a cell is taken from here.
  bool Tells(std::int64_t cell) const { return this->Place(cell) >= 0; }
  /// Value at a point of such a cell over the mean there: linear along each axis, or quadratic in
  /// parts of cells.
  double Value(std::int64_t cell, const Vec3& point) const;

private:
  /// In a cell, or on either side of a plate's plane.
  static constexpr int MostPlaces = 27;

  /// Where the plane of a light's plate cuts a cell.
  struct Cut
  {
    /// Axis that the plane faces most; -1: it does not cut the cell.
    int Axis = -1;
    /// Share of the cell along this axis that is below the plane, in the cell's middle, and its
    /// slopes along all axes, 0 along this one.
    double Middle = 0.0;
    Vec3 Slopes{0.0};

    /// That share at a place in the cell, itself given as shares along all axes.
    double Below(const Vec3& share) const;
  };
  struct Cell
  {
    std::int64_t Index = 0;
    Cut Plate;
    /// Places along each axis.
    int Along = 2;
    /// Whether light fills it below the plate's plane, and above: of a part of a cell, the side
    /// that its centre lies on.
    std::array<bool, 2> Sides{true, false};
    tbb::collaborative_once_flag Found;
    /// The light over its mean at the places, first axis fastest, of the whole cell, or of what
    /// lies below the plate's plane, then of what lies above it.
    std::array<std::array<double, MostPlaces>, 2> Values{};
  };

  /// Place of a cell among those that are looked at, or -1.
  int Place(std::int64_t cell) const;
  Cut CutOf(std::int64_t cell, std::size_t light) const;
  /// The place, or where that is not in the cell's own part the sample of the part next to it.
  Vec3 PlaceIn(std::int64_t cell, const Vec3& place) const;
  void Find(Cell& cell) const;

  const IndirectLight& Light_;
  const NearLights* Lights_ = nullptr;
  /// Of the cells that lights are near to, among those that are looked at.
  std::vector<std::int32_t> Places_;
  mutable std::deque<Cell> Cells_;
};

} // namespace smokevis
