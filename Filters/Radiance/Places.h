// Places on a rectilinear grid of so many cells, bricks or points along each axis.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace smokevis
{

/// Number of a place, x fastest.
inline std::int64_t PlaceNumber(const std::array<int, 3>& size, const std::array<int, 3>& place)
{
  return place[0] + size[0] * (place[1] + static_cast<std::int64_t>(size[1]) * place[2]);
}

/// Calls visit(place) for all places in the order of their numbers.
template <class Visit> void ForEachPlace(const std::array<int, 3>& size, Visit&& visit)
{
  std::array<int, 3> place;
  for (place[2] = 0; place[2] < size[2]; ++place[2])
  {
    for (place[1] = 0; place[1] < size[1]; ++place[1])
    {
      for (place[0] = 0; place[0] < size[0]; ++place[0])
      {
        visit(std::as_const(place));
      }
    }
  }
}

} // namespace smokevis
