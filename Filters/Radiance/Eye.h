// What limits an observer's eye beside the image that reaches it: adaptation, glare, and how
// observers differ.
#pragma once

#include "Contrast.h"

#include <vector>

namespace smokevis
{

/// State of an observer's eye.
struct Adaptation
{
  /// Luminance that the eye was adapted to before it came here [cd/m2]; 0: adapted to the dark.
  double Luminance = 0.0;
  /// Seconds since it left there.
  double Time = 0.0;
  /// Whether lamps, other signs and flames in the field of view veil the sign.
  bool Glare = false;
  /// Age of the observer in years; old eyes scatter more.
  double Age = 35.0;
};

/// Equivalent luminance that the earlier adaptation adds to the eye's own noise [cd/m2]. After CIE
/// 88 (lighting of road tunnels): for an eye adapted to L, 0.05 L is what still can be seen in at
/// the entrance, and it may fall as (1.9 + t)^-1.4 with the seconds t from there. Meant for the
/// first minute.
double AdaptationLuminance(double luminance, double time);

/// Veiling luminance over illuminance at the eye [1/sr] of a glare source, CIE 146 (2002), general
/// equation, for eyes of medium pigmentation (0.5): 10/a^3 + (5/a^2 + 0.05/a) (1 + (age/62.5)^4) +
/// 0.00125 with a in degrees. Valid from 0.1 to 100 degrees; nearer sources count as 0.1 degrees
/// away, further ones not at all.
/// @param angle between the source and the line of sight [rad]
double VeilPerIlluminance(double angle, double age);

/// Probability that an observer sees a contrast, when the thresholds of observers are normally
/// distributed; with a spread of 0 it is 0 or 1.
double VisibleProbability(double contrast, double threshold, double spread);

/// The sources of glare around an eye.
class GlareSources
{
public:
  /// Emitting plates in open view, and flames.
  GlareSources(const View& view, const Vec3& eye);

  /// Veiling luminance for an eye that looks at a sign [cd/m2]. The sign itself does not count.
  double VeilingLuminance(const Sign& sign, double age) const;

private:
  struct Source
  {
    /// Unit vector from the eye, and the angle that the source's radius spans [rad].
    Vec3 Direction;
    double Radius;
    /// On a plane that faces it [lx].
    double Illuminance;
    /// Of the sign that it is a part of; -1: a lamp or flame.
    int SignId;
  };

  /// Cuts a cell that is large in the eye's field of view into parts that are not.
  void AddParts(const View& view, const LightGroup& leaf);
  void AddPlate(const View& view, const Vec3& place, double radius, const Vec3& normal,
    const EmissionLaw& law, const Spectrum& intensity, int signId);
  void AddFlames(const View& view);

  Vec3 Eye_;
  std::vector<Source> Sources_;
};

/// The observer's limits when looking at a sign: the veil of glare and of earlier adaptation count
/// like noise of the eye's own, for they raise the mean luminance and leave differences alone.
/// @param sources of glare at the eye; null: none
Observer LookingAt(
  const Observer& rested, const Adaptation& state, const GlareSources* sources, const Sign& sign);

} // namespace smokevis
