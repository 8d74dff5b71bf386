// Random straight lines through a whole scene.
#pragma once

#include "Box.h"
#include "Sampler.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace smokevis
{

/// Lines of the uniform measure that meet the scene's box and, where the smoke fills little of it,
/// further ones that meet the smoke's. Each counts by the density of both kinds together (the
/// balance heuristic of Veach and Guibas 1995), so that sums over all of them have no bias.
class GlobalLines
{
public:
  struct Line
  {
    /// Where it enters the scene, and how far it goes there [m].
    Vec3 Origin, Direction;
    double Length;
    /// Power that it carries in each direction for each unit of its radiance [m2 sr].
    double Weight;
    /// A uniform random number of its own.
    double Random;
  };

  GlobalLines(const Box& scene, std::size_t lines);
  /// @param inner box inside the scene's
  /// @param lines through it, beside those through the scene
  void AddInner(const Box& inner, std::size_t lines);

  /// The same with a share of the lines, each of which counts for more.
  GlobalLines Thinned(double share) const;

  std::size_t Count() const { return this->Lines_ + this->InnerLines_; }
  const Box& Outer() const { return this->Scene_; }
  const std::optional<Box>& Inner() const { return this->Inner_; }
  /// How many of them are expected to meet a convex body (Cauchy's formula); at least so many where
  /// it lies outside the inner box.
  /// @param area of its surface; a plate has two sides [m2]
  /// @param inside whether it lies in the inner box
  double Meetings(double area, bool inside) const;

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
    EvenPoints Points_, InnerPoints_;
  };

private:
  Box Scene_;
  std::optional<Box> Inner_;
  std::size_t Lines_;
  std::size_t InnerLines_ = 0;
  /// Of lines that miss the inner box, and of those that meet it.
  double Weight_, InnerWeight_;
};

} // namespace smokevis
