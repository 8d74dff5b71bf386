// Random straight lines through a whole scene.
#pragma once

#include "Box.h"
#include "Sampler.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

/// Lines of the uniform measure that meet the scene's box and, where things lie closer together,
/// further ones that meet boxes in it; and such as run far through a box, of which those would be
/// few. Each counts by the density of all kinds together (the balance heuristic of Veach and Guibas
/// 1995), so that sums over all of them have no bias.
class GlobalLines
{
public:
  /// As many as are wanted, in whole lines: roundings must not make one more.
  static std::size_t AtLeast(double wanted);

  struct Line
  {
    /// Where it enters the scene, and how far it goes there [m].
    Vec3 Origin, Direction;
    double Length;
    /// Power that it carries in each direction for each unit of its radiance [m2 sr].
    double Weight;
    /// A uniform random number of its own.
    double Random;

    /// Of all lines there: so many lead through a unit of surface of a convex body [1/m2].
    double Density() const { return glm::half_pi<double>() / this->Weight; }
  };

  GlobalLines(const Box& scene, std::size_t lines);
  /// @param inner box inside the scene's
  /// @param lines through it, beside all others
  void AddInner(const Box& inner, std::size_t lines);
  /// Lines that join a place anywhere in one box with one anywhere in another: far ones as often as
  /// near ones.
  /// @param from, to boxes inside the scene's, which may be the same
  /// @param lines beside all others
  void AddJoining(const Box& from, const Box& to, std::size_t lines);

  /// The same with a share of the lines, each of which counts for more.
  GlobalLines Thinned(double share) const;

  std::size_t Count() const { return this->Kinds_.back().End; }
  const Box& Outer() const { return this->Kinds_.front().Through; }
  /// How many of them are expected to meet a convex body (Cauchy's formula); at least so many where
  /// it does not lie in one of the inner boxes.
  /// @param area of its surface; a plate has two sides [m2]
  /// @param bounds of it
  double Meetings(double area, const Box& bounds) const;

  /// One draw of all lines.
  class Draw
  {
  public:
    /// Different keys give independent lines.
    Draw(const GlobalLines& lines, std::uint64_t key);
    Line Get(std::size_t index) const;

  private:
    const GlobalLines& Lines_;
    std::uint64_t Key_;
    /// Of each kind: for lines through a box, and for such as join places in it.
    std::vector<EvenPoints<>> Points_;
    std::vector<EvenPoints<6>> Pairs_;
  };

private:
  /// Distances at which a line enters and leaves a box: the same where it misses it [m].
  struct Stretch
  {
    double Enter = 0.0, Leave = 0.0;
  };
  /// Lines drawn through one box.
  struct Kind
  {
    Box Through;
    std::size_t Lines;
    /// Behind its last among all lines.
    std::size_t End;
    /// In which each joins a place with one in the box; none: they only lead through that.
    std::optional<Box> With = {};

    /// Lines a unit of surface [1/m2]; of those that join places next to none are sure.
    double Density() const
    {
      return this->With ? 0.0 : static_cast<double>(this->Lines) / this->Through.Surface();
    }
    /// The same of lines that join places, close to one that goes through the boxes like this.
    double DensityAt(const Stretch& through, const Stretch& with) const;
  };

  /// The scene's first.
  std::vector<Kind> Kinds_;
};

} // namespace smokevis
