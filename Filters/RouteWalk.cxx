// Steps along routes, and looks around from their places.
#include "RouteWalk.h"

#include "Errors.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

namespace smokevis
{
namespace
{

double ExtinctionAt(const View& light, const Vec3& point)
{
  const Medium& smoke = light.TheScene().Smoke();
  const std::int64_t cell = smoke.Locate(point);
  return cell < 0 ? 0.0 : smoke.Extinction(cell);
}

/// Share of the second light field at a time, 0 to 1.
double Share(const RouteFrame& before, const RouteFrame& after, double time)
{
  return after.Time > before.Time
           ? std::clamp((time - before.Time) / (after.Time - before.Time), 0.0, 1.0)
           : 0.0;
}

double ExtinctionAt(
  const RouteFrame& before, const RouteFrame& after, const Vec3& point, double share)
{
  const double first = share < 1.0 ? ExtinctionAt(*before.Light, point) : 0.0;
  const double second = share > 0.0 ? ExtinctionAt(*after.Light, point) : 0.0;
  return (1.0 - share) * first + share * second;
}

/// What is seen from one eye point.
FloorMap LookAround(const View& light, const FloorMapOptions& options)
{
  Progress unheard;
  return ComputeFloorMap(light, options, unheard);
}

} // namespace

//------------------------------------------------------------------------------
RouteWalk::RouteWalk(std::vector<RouteWalker> walkers, const RouteOptions& options)
    : Walkers_(std::move(walkers)), Options_(options)
{
  for (RouteWalker& walker : this->Walkers_)
  {
    if (!walker.Way.TimesGiven && !walker.Way.Place.empty())
    {
      walker.Way.Time.assign(1, options.StartTime);
    }
  }
}

//------------------------------------------------------------------------------
double RouteWalk::StartTime() const
{
  double start = std::numeric_limits<double>::infinity();
  for (const RouteWalker& walker : this->Walkers_)
  {
    start = std::min(start, walker.Way.Time.front());
  }
  return start;
}

//------------------------------------------------------------------------------
bool RouteWalk::Done() const
{
  return std::all_of(this->Walkers_.begin(), this->Walkers_.end(),
    [](const RouteWalker& walker) { return walker.Arrived(); });
}

//------------------------------------------------------------------------------
void RouteWalk::Walk(std::size_t index, const RouteFrame& before, const RouteFrame& after,
  bool last, std::vector<Visit>& visits)
{
  RouteWalker& walker = this->Walkers_[index];
  Route& way = walker.Way;
  while (!walker.Arrived())
  {
    const std::size_t place = walker.Speed.size();
    const double time = way.Time[place];
    if (time > after.Time && !last)
    {
      return;
    }
    const double share = Share(before, after, time);
    visits.push_back({index, place, share});
    walker.Extinction.push_back(ExtinctionAt(before, after, this->Eye(way.Place[place]), share));
    walker.Beyond.push_back(time < before.Time || time > after.Time);
    if (place + 1 == way.Place.size())
    {
      walker.Speed.push_back(walker.Speed.empty() ? 0.0 : walker.Speed.back());
      return;
    }
    const double length = way.Distance[place + 1] - way.Distance[place];
    double speed = this->Options_.Speed;
    if (way.TimesGiven)
    {
      speed = length / (way.Time[place + 1] - time);
    }
    else
    {
      // The smoke half-way counts, when the walker is there, which depends on the speed; it changes
      // little within a step.
      constexpr int Iterations = 3;
      const Vec3 halfWay = this->Eye(0.5 * (way.Place[place] + way.Place[place + 1]));
      for (int i = 0; i < Iterations; ++i)
      {
        const double then = Share(before, after, time + 0.5 * length / speed);
        speed = WalkingSpeed(this->Options_.Law, this->Options_.Speed,
          ExtinctionAt(before, after, halfWay, then), this->Options_.SpeedFactor);
      }
      way.Time.push_back(time + length / speed);
    }
    walker.Speed.push_back(speed);
  }
}

//------------------------------------------------------------------------------
void RouteWalk::Look(const RouteFrame& before, const RouteFrame& after, const Visit& visit)
{
  RouteWalker& walker = this->Walkers_[visit.Walker];
  const std::size_t signs = before.Light->TheScene().Lights().Signs().size();
  FloorMapOptions options;
  options.PlacesX = options.PlacesY = options.Threads = 1;
  options.FirstPlace = this->Eye(walker.Way.Place[visit.Place]);
  options.ContrastThreshold = this->Options_.ContrastThreshold;
  options.Eye = this->Options_.Eye;
  options.State.Luminance = this->Options_.AdaptationLuminance;
  options.State.Time = walker.Way.Time[visit.Place] - walker.Way.Time.front();
  float* const contrast = walker.PerceivedContrast.data() + visit.Place * signs;
  std::fill_n(contrast, signs, 0.0F);
  bool inView = false;
  bool solid = true;
  for (const auto& [frame, weight] :
    {std::pair{&before, 1.0 - visit.Share}, std::pair{&after, visit.Share}})
  {
    if (weight == 0.0)
    {
      continue;
    }
    const FloorMap seen = LookAround(*frame->Light, options);
    for (std::size_t sign = 0; sign < signs; ++sign)
    {
      contrast[sign] += static_cast<float>(weight * seen.PerceivedContrast[sign]);
    }
    inView = inView || seen.BestSign[0] >= 0;
    solid = solid && seen.Status[0] == PlaceStatus::InsideSolid;
  }
  const float* const best = std::max_element(contrast, contrast + signs);
  const bool visible = inView && *best >= this->Options_.ContrastThreshold;
  walker.Sight.Visibility[visit.Place] = *best;
  walker.Sight.InView[visit.Place] = inView ? 1 : 0;
  walker.BestSign[visit.Place] =
    inView ? before.Light->TheScene().Lights().Signs()[best - contrast].Id : -1;
  walker.Status[visit.Place] = solid     ? PlaceStatus::InsideSolid
                               : !inView ? PlaceStatus::NoSignInView
                               : visible ? PlaceStatus::Seen
                                         : PlaceStatus::BelowThreshold;
}

//------------------------------------------------------------------------------
void RouteWalk::Advance(
  const RouteFrame& before, const RouteFrame& after, bool last, Progress& progress)
{
  const std::size_t signs = before.Light->TheScene().Lights().Signs().size();
  if (signs == 0 || after.Light->TheScene().Lights().Signs().size() != signs)
  {
    throw Error("light field", signs == 0 ? "it holds no sign" : "its signs change with time",
      "Give emitters with a SignId from 0, the same at all times");
  }
  std::vector<Visit> visits;
  for (std::size_t i = 0; i < this->Walkers_.size(); ++i)
  {
    RouteWalker& walker = this->Walkers_[i];
    const std::size_t places = walker.Way.Place.size();
    walker.Sight.Visibility.resize(places);
    walker.Sight.InView.resize(places);
    walker.BestSign.resize(places, -1);
    walker.Status.resize(places);
    walker.PerceivedContrast.resize(places * signs);
    this->Walk(i, before, after, last, visits);
  }
  tbb::parallel_for(std::size_t{0}, visits.size(),
    [&](std::size_t i)
    {
      if (!progress.ShouldStop())
      {
        this->Look(before, after, visits[i]);
      }
    });
}

} // namespace smokevis
