// Places along a way, and what was seen from them in short.
#include "Route.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace smokevis
{
namespace
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
/// Places of one route, beyond which memory is likely a mistake.
constexpr double MaximumPlaces = 1e6;

void Check(const std::vector<Vec3>& corners, const std::vector<double>& times)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const std::string where = "corner " + std::to_string(i) + " of a route";
    const Vec3& corner = corners[i];
    if (!std::isfinite(corner.x) || !std::isfinite(corner.y) || !std::isfinite(corner.z))
    {
      throw Error(where, "its coordinates are not finite", "Give metres");
    }
    if (times.empty())
    {
      continue;
    }
    if (!std::isfinite(times[i]))
    {
      throw Error(where, "its time is not finite", "Give seconds");
    }
    if (i > 0 &&
        (times[i] < times[i - 1] || (times[i] == times[i - 1] && corner != corners[i - 1])))
    {
      throw Error(where, "its time is not after that of the corner before",
        "Sort the corners by time, and give each route a number of its own");
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
Route SampleRoute(const std::vector<Vec3>& corners, const std::vector<double>& times,
  double spacing, double interval)
{
  Check(corners, times);
  Route route;
  route.TimesGiven = !times.empty();
  if (corners.empty())
  {
    return route;
  }
  route.Place.push_back(corners.front());
  route.Distance.push_back(0.0);
  if (route.TimesGiven)
  {
    route.Time.push_back(times.front());
  }
  for (std::size_t i = 1; i < corners.size(); ++i)
  {
    const double length = glm::length(corners[i] - corners[i - 1]);
    const double duration = route.TimesGiven ? times[i] - times[i - 1] : 0.0;
    if (length == 0.0 && duration == 0.0)
    {
      continue;
    }
    const double parts =
      std::max(1.0, std::max(std::ceil(length / spacing), std::ceil(duration / interval)));
    if (static_cast<double>(route.Place.size()) + parts > MaximumPlaces)
    {
      throw Error("a route", "it would have more than a million places",
        "Raise SampleSpacing, and check that lengths are in metres and times in seconds");
    }
    const double from = route.Distance.back();
    for (int part = 1; part <= static_cast<int>(parts); ++part)
    {
      const double share = part / parts;
      route.Place.push_back(glm::mix(corners[i - 1], corners[i], share));
      route.Distance.push_back(from + share * length);
      if (route.TimesGiven)
      {
        route.Time.push_back(times[i - 1] + share * duration);
      }
    }
  }
  return route;
}

//------------------------------------------------------------------------------
RouteSummary Summarize(const Route& route, const RouteSight& sight, double threshold)
{
  RouteSummary summary;
  summary.FirstLossTime = summary.FirstLossDistance = NotANumber;
  summary.FirstLossPlace = Vec3(NotANumber);
  if (route.Place.empty())
  {
    return summary;
  }
  summary.Length = route.Distance.back();
  summary.Duration = route.Time.back() - route.Time.front();
  summary.LeastVisibility = *std::min_element(sight.Visibility.begin(), sight.Visibility.end());
  const auto visible = [&](std::size_t i)
  { return sight.InView[i] != 0 && sight.Visibility[i] >= threshold; };
  // Where the last stretch without a visible sign begins, counted from the route's first place.
  double lostSince = route.Time.front();
  const auto lose = [&](std::size_t i, double share)
  {
    const std::size_t next = std::min(i + 1, route.Place.size() - 1);
    lostSince = glm::mix(route.Time[i], route.Time[next], share);
    if (std::isnan(summary.FirstLossTime))
    {
      summary.FirstLossTime = lostSince;
      summary.FirstLossDistance = glm::mix(route.Distance[i], route.Distance[next], share);
      summary.FirstLossPlace = glm::mix(route.Place[i], route.Place[next], share);
    }
  };
  const auto end = [&](double time)
  { summary.LongestInvisibleTime = std::max(summary.LongestInvisibleTime, time - lostSince); };
  if (!visible(0))
  {
    lose(0, 0.0);
  }
  for (std::size_t i = 0; i + 1 < route.Place.size(); ++i)
  {
    const bool before = visible(i);
    const bool after = visible(i + 1);
    double invisible = before ? 0.0 : 1.0;
    if (before != after)
    {
      const double change = sight.Visibility[i + 1] - sight.Visibility[i];
      const double share =
        change == 0.0 ? 1.0 : std::clamp((threshold - sight.Visibility[i]) / change, 0.0, 1.0);
      invisible = before ? 1.0 - share : share;
      if (before)
      {
        lose(i, share);
      }
      else
      {
        end(glm::mix(route.Time[i], route.Time[i + 1], share));
      }
    }
    summary.InvisibleTime += invisible * (route.Time[i + 1] - route.Time[i]);
    summary.InvisibleDistance += invisible * (route.Distance[i + 1] - route.Distance[i]);
  }
  if (!visible(route.Place.size() - 1))
  {
    end(route.Time.back());
  }
  return summary;
}

} // namespace smokevis
