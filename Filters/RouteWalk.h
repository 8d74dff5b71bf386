// Walks routes through smoke that changes, from one light field to the next.
#pragma once

#include "FloorMap.h"
#include "Route.h"
#include "WalkingSpeed.h"

#include <vector>

namespace smokevis
{

/// The light field at a time.
struct RouteFrame
{
  double Time = 0.0;
  const View* Light = nullptr;
};

struct RouteOptions
{
  /// Height of the eyes above the route [m].
  double EyeHeight = 1.7;
  /// When routes without times begin [s], and their speed in clear air [m/s].
  double StartTime = 0.0;
  double Speed = 1.19;
  SpeedLaw Law = SpeedLaw::Constant;
  /// Fridolf's A.
  double SpeedFactor = 2.0;
  double ContrastThreshold = 0.2;
  Observer Eye;
  /// What the eye was adapted to when the route begins [cd/m2].
  double AdaptationLuminance = 0.0;
};

/// One walker. Values a place of the route; a sign's values follow each other.
struct RouteWalker
{
  Route Way;
  RouteSight Sight;
  std::vector<double> Speed, Extinction;
  std::vector<int> BestSign;
  std::vector<PlaceStatus> Status;
  std::vector<float> PerceivedContrast;
  /// Whether the place was reached before the first or after the last light field, which then
  /// counts.
  std::vector<bool> Beyond;

  bool Arrived() const { return this->Speed.size() == this->Way.Place.size(); }
};

/// Moves walkers on as long as they are between two light fields. Extinction and contrasts are
/// linear in time between them.
class RouteWalk
{
public:
  RouteWalk(std::vector<RouteWalker> walkers, const RouteOptions& options);

  /// When the first walker begins [s].
  double StartTime() const;
  bool Done() const;
  /// Lets the walkers go on until the second light field's time.
  /// @param last whether there is no later one: then walkers go on to the end of their routes
  void Advance(const RouteFrame& before, const RouteFrame& after, bool last, Progress& progress);
  const std::vector<RouteWalker>& Walkers() const { return this->Walkers_; }

private:
  struct Visit
  {
    std::size_t Walker, Place;
    /// Share of the second light field.
    double Share;
  };
  void Walk(std::size_t index, const RouteFrame& before, const RouteFrame& after, bool last,
    std::vector<Visit>& visits);
  void Look(const RouteFrame& before, const RouteFrame& after, const Visit& visit);
  Vec3 Eye(const Vec3& place) const { return place + Vec3(0.0, 0.0, this->Options_.EyeHeight); }

  std::vector<RouteWalker> Walkers_;
  RouteOptions Options_;
};

} // namespace smokevis
