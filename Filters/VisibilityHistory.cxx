// Adds up what a series of floor maps says of each place.
#include "VisibilityHistory.h"

#include "Errors.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace smokevis
{
namespace
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

} // namespace

//------------------------------------------------------------------------------
VisibilityHistory::VisibilityHistory(std::size_t places, double threshold)
    : Threshold_(threshold), InView_(places), Seen_(places), Missed_(places), Free_(places)
{
  for (std::vector<double>* const times : {&this->Sums_.AvailableTime, &this->Sums_.FinalLossTime,
         &this->Sums_.AvailableTimeInterval, &this->Sums_.InvisibleTime})
  {
    times->assign(places, 0.0);
  }
  this->Sums_.FirstSign.assign(places, -1);
  this->Sums_.LastSign.assign(places, -1);
  this->Sums_.LeastVisibility.assign(places, std::numeric_limits<float>::infinity());
}

//------------------------------------------------------------------------------
void VisibilityHistory::Add(VisibilityFrame frame)
{
  const std::size_t places = this->Seen_.size();
  if (frame.Visibility.size() != places || frame.BestSign.size() != places ||
      frame.InsideSolid.size() != places)
  {
    throw Error("map at " + std::to_string(frame.Time) + " s",
      "its number of places differs from that of the first map",
      "Give maps of one resolution for all times");
  }
  const bool first = this->Frames_ == 0;
  if (!first && !(frame.Time > this->Last_.Time))
  {
    throw Error("map at " + std::to_string(frame.Time) + " s",
      "its time is not after that of the map before it, " + std::to_string(this->Last_.Time) + " s",
      "Check the time steps of the input");
  }
  if (first)
  {
    this->FirstTime_ = frame.Time;
  }
  for (std::size_t place = 0; place < places; ++place)
  {
    this->AddPlace(place, frame, first);
  }
  this->Last_ = std::move(frame);
  ++this->Frames_;
}

//------------------------------------------------------------------------------
void VisibilityHistory::AddPlace(std::size_t place, const VisibilityFrame& frame, bool first)
{
  Summary& sums = this->Sums_;
  const float value = frame.Visibility[place];
  const bool visible = this->Visible(frame, place);
  sums.LeastVisibility[place] = std::min(sums.LeastVisibility[place], value);
  this->InView_[place] = this->InView_[place] || frame.BestSign[place] >= 0;
  this->Free_[place] = this->Free_[place] || !frame.InsideSolid[place];
  if (visible)
  {
    if (!this->Seen_[place])
    {
      sums.FirstSign[place] = frame.BestSign[place];
    }
    sums.LastSign[place] = frame.BestSign[place];
    this->Seen_[place] = true;
  }

  const bool before = first ? visible : this->Visible(this->Last_, place);
  double crossing = frame.Time;
  if (before != visible)
  {
    const double from = this->Last_.Visibility[place];
    const double change = static_cast<double>(value) - from;
    // A threshold of 0 has no contrast below it: the sign came into view, or went, with this map.
    const double share =
      change == 0.0 ? 1.0 : std::clamp((this->Threshold_ - from) / change, 0.0, 1.0);
    crossing = this->Last_.Time + share * (frame.Time - this->Last_.Time);
  }
  if (!first)
  {
    sums.InvisibleTime[place] +=
      before ? (visible ? 0.0 : frame.Time - crossing) : crossing - this->Last_.Time;
  }
  if (!visible && (first || before))
  {
    sums.FinalLossTime[place] = crossing;
    if (!this->Missed_[place])
    {
      sums.AvailableTime[place] = crossing;
      sums.AvailableTimeInterval[place] = first ? 0.0 : frame.Time - this->Last_.Time;
    }
    this->Missed_[place] = true;
  }
}

//------------------------------------------------------------------------------
VisibilityHistory::Summary VisibilityHistory::Finish() const
{
  Summary result = this->Sums_;
  const std::size_t places = this->Seen_.size();
  result.Outcome.resize(places);
  for (std::size_t place = 0; place < places; ++place)
  {
    PlaceOutcome outcome = PlaceOutcome::Kept;
    const bool visible = this->Frames_ > 0 && this->Visible(this->Last_, place);
    if (!this->InView_[place])
    {
      outcome = this->Free_[place] ? PlaceOutcome::NoSignInView : PlaceOutcome::InsideSolid;
    }
    else if (!this->Seen_[place])
    {
      outcome = PlaceOutcome::NeverVisible;
    }
    else if (!visible)
    {
      outcome = PlaceOutcome::Lost;
    }
    else if (this->Missed_[place])
    {
      outcome = PlaceOutcome::Interrupted;
    }
    result.Outcome[place] = outcome;
    if (!this->InView_[place])
    {
      result.AvailableTime[place] = result.FinalLossTime[place] = NotANumber;
      result.InvisibleTime[place] = result.AvailableTimeInterval[place] = NotANumber;
    }
    else
    {
      result.AvailableTime[place] =
        this->Missed_[place] ? result.AvailableTime[place] : this->Last_.Time;
      result.FinalLossTime[place] = visible ? this->Last_.Time : result.FinalLossTime[place];
    }
  }
  return result;
}

} // namespace smokevis
