// Places along a ray for integrals of a near light's fluence.
#pragma once

#include "Emitters.h"
#include "GaussNodes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace smokevis
{

/// Gauss points between two distances along a ray.
struct GaussRule
{
  int Count;
  std::array<double, 4> Nodes, Weights;
};
inline constexpr GaussRule OnePoint = {1, {0.5}, {1.0}};
inline constexpr GaussRule TwoPoints = {2, {Nodes2[0], Nodes2[1]}, {0.5, 0.5}};
inline constexpr GaussRule FourPoints = {4, Nodes4, Weights4};

/// Equiangular places about a light follow 1/d^2 along a ray (Kulla and Fajardo 2012); a light of
/// some size is no steeper than its radius.
class Equiangular
{
public:
  Equiangular(const LightGroup& light, const Vec3& origin, const Vec3& direction)
      : Middle_(glm::dot(light.Centre - origin, direction)),
        Aside_(glm::length(origin + Middle_ * direction - light.Centre)),
        Width_(std::max({Aside_, 0.5 * light.Radius, 1e-9}))
  {
  }

  struct Place
  {
    /// Along the ray, and the length that it stands for.
    double Distance, Step;
  };
  /// The place at a share of the angle between two distances.
  Place At(double from, double to, double share) const
  {
    const double low = std::atan(this->Tangent(from));
    const double span = std::atan(this->Tangent(to)) - low;
    const double tangent = std::tan(low + span * share);
    return {this->Distance(tangent, from, to), span * this->Width_ * (1.0 + tangent * tangent)};
  }
  /// Calls visit(distance along the ray, step) for the places of a rule between two distances.
  /// @param span angle between them [rad]
  template <class Visit>
  void ForEach(const GaussRule& rule, double from, double to, double span, Visit&& visit) const
  {
    // Tangents of sums: the middle of the angle has that of the sum of its ends' directions, and
    // places lie as far before it as behind.
    const double low = this->Tangent(from);
    const double high = this->Tangent(to);
    const double lowLength = std::sqrt(1.0 + low * low);
    const double highLength = std::sqrt(1.0 + high * high);
    const double middle = (low * highLength + high * lowLength) / (lowLength + highLength);
    for (int i = 0; i < rule.Count; i += 2)
    {
      const bool alone = i + 1 == rule.Count;
      const double off = alone ? 0.0 : std::tan((0.5 - rule.Nodes[i / 2]) * span);
      const auto take = [&](double change)
      {
        const double tangent = (middle + change) / (1.0 - middle * change);
        visit(this->Distance(tangent, from, to),
          rule.Weights[i / 2] * span * this->Width_ * (1.0 + tangent * tangent));
      };
      take(-off);
      if (!alone)
      {
        take(off);
      }
    }
  }
  /// Angle between two distances.
  double Span(double from, double to) const
  {
    const double low = this->Tangent(from);
    const double high = this->Tangent(to);
    return std::atan2(high - low, 1.0 + low * high);
  }
  /// Whether a part of the ray stays farther from the light's centre than some distance.
  bool Beyond(double distance, double from, double to) const
  {
    const double along = std::max({from - this->Middle_, this->Middle_ - to, 0.0});
    return this->Aside_ * this->Aside_ + along * along > distance * distance;
  }

private:
  double Tangent(double distance) const { return (distance - this->Middle_) / this->Width_; }
  double Distance(double tangent, double from, double to) const
  {
    return std::clamp(this->Middle_ + this->Width_ * tangent, from, to);
  }

  double Middle_, Aside_, Width_;
};

/// Places of a quadrature of a light's fluence along a ray.
class LightQuadrature
{
public:
  /// @param pattern length over which the light changes right before the plate [m]
  LightQuadrature(const LightGroup& light, double pattern, const Vec3& origin,
    const Vec3& direction, double extinction)
      : Light_(light), Pattern_(pattern), Origin_(origin), Direction_(direction),
        Extinction_(extinction), Sharpness_(light.Law.Sharpness()),
        Places_(light, origin, direction)
  {
  }

  /// Calls visit(distance along the ray, step) for what lies before the light's plate of a piece of
  /// the ray.
  template <class Visit> void ForEach(double begin, double end, Visit&& visit) const
  {
    const double first = this->Height(begin);
    const double last = this->Height(end);
    if (first <= 0.0 && last <= 0.0)
    {
      return;
    }
    const auto at = [&](double share) { return std::min(begin + (end - begin) * share, end); };
    const double plane = at(std::clamp(first / (first - last), 0.0, 1.0));
    const double from = first < 0.0 ? plane : begin;
    const double to = last < 0.0 ? plane : end;
    if (std::max(last, 0.0) >= Grading * first)
    {
      this->ForEachOf(from, to, MostHalvings, visit);
      return;
    }
    const double cut = std::min(at((1.0 - Grading) * first / (first - last)), to);
    this->ForEachOf(from, cut, MostHalvings, visit);
    // A ray that runs along the plate may pass many edges there.
    const bool steep = to - cut <= LongestSteep * this->Height(cut);
    this->ForEachOf(cut, to, steep ? 0 : MostHalvings, visit);
  }

private:
  /// A piece of a ray into a plate is cut so much closer to the plate: behind, the light follows
  /// the pattern.
  static constexpr double Grading = 0.25;
  /// Length over height of such a last part up to which it is not halved, wherever it ends.
  static constexpr double LongestSteep = 2.0;
  /// So many times its height before the plate a place counts as far from the edges of the pattern,
  /// and no nearer than a part of the pattern is long.
  static constexpr double PatternHeights = 2.0;
  /// Parts of a piece of a ray are halved so often at most.
  static constexpr int MostHalvings = 3;
  /// Largest parts that Gauss points of some number serve: their length over the distance from the
  /// plate's edges, or, so many radii away from the light and one from its edges, the angle that
  /// they span there; and their optical depth. Close to the light its fluence is smooth but at the
  /// edges (it follows a solid angle, a harmonic function): the error of n points goes with rho^-2n
  /// of the Bernstein ellipse through the nearest edge (Trefethen 2013), 1e-3 for four points
  /// beside it. Far away the rules' errors are angle^2 / 24 and angle^4 / 4320.
  struct PartLimit
  {
    double Length, Angle, Depth;
  };
  static constexpr double FarRadii = 1.5;
  static constexpr PartLimit OnePointPart = {0.25, 0.15, 0.15};
  static constexpr PartLimit TwoPointPart = {1.33, 0.8, 0.8};
  static constexpr PartLimit FourPointPart = {2.0, 2.0, 1.0};

  double Height(double distance) const
  {
    return glm::dot(
      this->Origin_ + distance * this->Direction_ - this->Light_.Centre, this->Light_.Normal);
  }

  template <class Visit> void ForEachOf(double begin, double end, int halvings, Visit&& visit) const
  {
    const double length = end - begin;
    const double middle = 0.5 * (begin + end);
    const double edges =
      std::min(this->Light_.EdgeDistance(this->Origin_ + middle * this->Direction_),
        std::max(this->Pattern_, PatternHeights * this->Height(middle)));
    const bool far = edges >= this->Light_.Radius &&
                     this->Places_.Beyond(FarRadii * this->Light_.Radius, begin, end);
    const double unit = far ? 1.0 : edges;
    const double size = far ? this->Places_.Span(begin, end) : length;
    const auto within = [&](const PartLimit& limit)
    {
      return this->Sharpness_ * size <= unit * (far ? limit.Angle : limit.Length) &&
             this->Extinction_ * length <= limit.Depth;
    };
    if (halvings > 0 && !within(FourPointPart))
    {
      this->ForEachOf(begin, middle, halvings - 1, visit);
      this->ForEachOf(middle, end, halvings - 1, visit);
      return;
    }
    const GaussRule& rule = !within(TwoPointPart)  ? FourPoints
                            : within(OnePointPart) ? OnePoint
                                                   : TwoPoints;
    this->Places_.ForEach(rule, begin, end, far ? size : this->Places_.Span(begin, end), visit);
  }

  const LightGroup& Light_;
  double Pattern_;
  Vec3 Origin_, Direction_;
  double Extinction_;
  /// How fast the light changes with the angle, 1 or more.
  double Sharpness_;
  Equiangular Places_;
};

} // namespace smokevis
