#include "ZoneChanges.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

ZoneChanges::ZoneChanges(const SignSight& sight, const SignSight::Part& part)
    : Resolved_(sight.Resolved()), Rows_(part.Zones.size())
{
  const std::vector<SignSight::Zone>& zones = part.Zones;
  std::array<std::size_t, 2> size{};
  for (const SignSight::Zone& zone : zones)
  {
    size = {std::max(size[0], zone.At[0] + 1), std::max(size[1], zone.At[1] + 1)};
  }
  std::vector<std::optional<std::size_t>> numbers(size[0] * size[1]);
  const auto numberAt = [&](std::array<std::size_t, 2> at) -> std::optional<std::size_t>&
  { return numbers[at[0] + size[0] * at[1]]; };
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    numberAt(zones[i].At) = i;
  }
  const auto placeOf = [&](std::size_t zone) -> const SeenPlace&
  { return sight.Places()[zones[zone].Place]; };
  const auto apart = [&](std::size_t zone, std::size_t next, int axis)
  {
    const SeenPlace& before = placeOf(zone);
    const SeenPlace& behind = placeOf(next);
    // Middles of what is seen of two zones may lie closer than they do.
    return std::max(
      0.25 * (before.Size[axis] + behind.Size[axis]), behind.OnPlate[axis] - before.OnPlate[axis]);
  };
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const std::size_t at = zones[i].At[axis];
      // A zone between two others tells most; one at a rim is told of by the two beside it.
      for (const std::size_t before : {1, 0, 2})
      {
        if (this->Rows_[i][axis] || at < before || at - before + 2 >= size[axis])
        {
          continue;
        }
        std::array<std::size_t, 2> place = zones[i].At;
        std::array<std::optional<std::size_t>, 3> row;
        for (std::size_t j = 0; j < 3; ++j)
        {
          place[axis] = at - before + j;
          row[j] = numberAt(place);
        }
        if (row[0] && row[1] && row[2])
        {
          const double own = placeOf(i).Size[axis];
          this->Rows_[i][axis] = Row{{*row[0], *row[1], *row[2]},
            {apart(*row[0], *row[1], axis) / own, apart(*row[1], *row[2], axis) / own}};
        }
      }
    }
  }
}

std::vector<glm::dvec2> ZoneChanges::Of(const std::vector<double>& values) const
{
  std::vector<glm::dvec2> changes(this->Rows_.size(), glm::dvec2(0.0));
  for (std::size_t i = 0; i < changes.size() && this->Resolved_; ++i)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      if (const std::optional<Row>& row = this->Rows_[i][axis])
      {
        // Where smoke begins or is uneven, one side tells nothing of the other.
        const Steps steps = row->Of(values);
        changes[i][axis] =
          std::copysign(std::sqrt(std::max(0.0, steps.Before * steps.Behind)), steps.Before);
      }
    }
  }
  return changes;
}

std::vector<double> ZoneChanges::Unevenness(const std::vector<double>& values) const
{
  // Of values that differ from a line by independent errors, second differences have six times
  // their variance.
  constexpr double Variances = 6.0;
  std::vector<double> errors(this->Rows_.size(), 0.0);
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    for (const std::optional<Row>& row : this->Rows_[i])
    {
      if (row)
      {
        const Steps steps = row->Of(values);
        errors[i] = std::hypot(errors[i], (steps.Behind - steps.Before) / std::sqrt(Variances));
      }
    }
  }
  return errors;
}

} // namespace smokevis
