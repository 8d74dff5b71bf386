// Light that the smoke between an eye and a sign's plate adds.
#pragma once

#include "PlateColumns.h"
#include "VeilGather.h"
#include "View.h"

#include <algorithm>
#include <array>
#include <vector>

namespace smokevis
{

/// What an eye sees of a part of a plate: the part's middle, on the sign's rectangle and in space,
/// its size along the rectangle's edges, 0 to 1, and its solid angle.
struct SeenPlace
{
  glm::dvec2 OnPlate{0.0};
  glm::dvec2 Size{0.0};
  Vec3 Point{0.0};
  double Weight = 0.0;
};

/// Veil before the places that an eye sees of a sign, in one band.
class SignVeil
{
public:
  /// @param places that the eye sees; they must, as all but the band, outlive this
  SignVeil(const View& view, const Vec3& eye, int band, const std::vector<SeenPlace>& places)
      : View_(view), Eye_(eye), Band_(band), Places_(places)
  {
  }
  virtual ~SignVeil() = default;
  SignVeil(const SignVeil&) = delete;
  SignVeil& operator=(const SignVeil&) = delete;

  /// The batches of the veil before a place [cd/m2].
  virtual Lanes At(std::size_t place) const = 0;

  /// Gathers the level of what is multiply scattered on the ways that veils differ little over
  /// (View::GatherVeil) and takes it where it is clearly known better so. How the veil varies over
  /// the plate stays as it is. Returns the number of rays.
  std::size_t Gather();

protected:
  /// A way whose light counts in the level, and that light.
  struct Way
  {
    SightLine Line;
    RayLight Light;
  };

  /// @param ahead veil of the smoke up to `begin` [cd/m2]
  RayLight Trace(const Vec3& direction, double begin, double end, double ahead = 0.0) const
  {
    return this->View_.TraceVeil(this->Eye_, direction, begin, end, this->Band_, ahead);
  }

  const View& View_;
  const Vec3& Eye_;
  int Band_;
  const std::vector<SeenPlace>& Places_;
  std::vector<Way> Ways_;
};

/// Veil over the whole plate. Far from the plate the smoke's light varies slowly over it and is
/// interpolated between three by three rays, of which six tell the others where it hardly bends.
/// Close to the plate the smoke glows in the pattern's shape, so that each column and row of it
/// gets rays of its own, and each half of it where little noise is asked for and there are few.
class PlateVeil : public SignVeil
{
public:
  PlateVeil(const View& view, const Vec3& eye, int band, const std::vector<SeenPlace>& places,
    const Sign& sign, const PlateColumns& columns, const PlateColumns& rows);

  Lanes At(std::size_t place) const override;

  /// Roughness (Roughness.h) of the veil that the three by three rays tell, over its mean.
  double RelativeRoughness() const;

private:
  /// Tells the light of three ways from that of the others, if the veil bends little enough over
  /// the plate. Returns whether it does.
  bool TellRest();
  /// Takes halves of the columns and rows, those that are longer first, while they are few.
  void Halve(const Sign& sign);

  /// Of the two Gauss points of a column by those of a row.
  static constexpr std::size_t Nodes = 4;

  /// Of the pattern, or halves of these.
  PlateColumns Columns_, Rows_;
  /// What is added close to the plate, at the nodes of each column of each row.
  std::vector<std::array<Lanes, Nodes>> Near_;
};

/// Columns (or rows) of a sign's pattern, and what the cells of smoke right before it divide them
/// into: what glows there jumps from cell to cell, and what is scattered farther away bends.
struct PlateAxis
{
  /// @param pattern must outlive this
  /// @param edge as of PlateColumns
  PlateAxis(const View& view, const Sign& sign, const PlateColumns& pattern, int edge);

  bool IsDivided() const { return this->Divided.Count() > this->Pattern.Count(); }

  const PlateColumns& Pattern;
  PlateColumns Divided;
};

/// Veil with a ray to each place: before what shows of a plate that is partly hidden, as rays past
/// what hides it would tell of smoke that is not seen, behind rough smoke, and before a plate
/// without a pattern. Where all of the plate is in view and smoke divides it, there is one to each
/// piece of a place. Close to a plate with a pattern that is all in view, the mean over each place
/// is that of two Gauss points along each edge that the pattern or the smoke changes along, and
/// stays as the field has it where the rest is gathered, as before a PlateVeil's.
class ShownVeil : public SignVeil
{
public:
  /// @param axes along both edges
  /// @param whole whether all of the plate is in view
  ShownVeil(const View& view, const Vec3& eye, int band, const std::vector<SeenPlace>& places,
    const Sign& sign, const std::array<PlateAxis, 2>& axes, bool whole);

  Lanes At(std::size_t place) const override;

private:
  /// Mean over a place of what is added close to it.
  /// @param ahead veil of the smoke on the way there [cd/m2]
  Lanes MeanCloseTo(const SeenPlace& place, const Sign& sign, const std::array<PlateAxis, 2>& axes,
    double ahead) const;

  /// Share of its place that each way tells of, and the first way to each place, and the end.
  std::vector<float> Shares_;
  std::vector<std::size_t> First_;
  /// What is added close to the plate before each place, if that is told by itself.
  std::vector<Lanes> Near_;
};

} // namespace smokevis
