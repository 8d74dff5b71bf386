// Light that the smoke between an eye and a sign's plate adds, over the plate.
#pragma once

#include "VeilGather.h"
#include "View.h"

#include <algorithm>
#include <vector>

namespace smokevis
{

/// Columns (or rows) of a sign's pattern along one edge of the plate.
struct PlateColumns
{
  /// Where they begin and end, 0 to 1.
  std::vector<double> Ends;
  double Widest = 1.0;

  /// @param borders where cells begin and end, in any order; a pattern with too many of them to be
  /// told apart in the smoke's glow counts as one column
  explicit PlateColumns(std::vector<double> borders);

  std::size_t Count() const { return this->Ends.size() - 1; }
  std::size_t Of(double t) const;
  /// The two Gauss points of a column.
  double Node(std::size_t column, int index) const;
};

/// A place on the rectangle around a sign, 0 to 1 along both edges.
Vec3 OnPlate(const Sign& sign, double u, double v);
glm::dvec2 PlaceOnPlate(const Sign& sign, const Vec3& point);

/// Veil over the plate, in one band. Far from the plate the smoke's light varies
/// slowly over it and is interpolated between three by three rays. Close to the plate the smoke
/// glows in the pattern's shape, so that each column and row of it gets rays of its own.
class PlateVeil
{
public:
  PlateVeil(const View& view, const Sign& sign, const Vec3& eye, int band,
    const PlateColumns& columns, const PlateColumns& rows);

  /// The batches of the veil at a place [cd/m2].
  Lanes At(const glm::dvec2& place) const;

  /// Gathers the level of what is multiply scattered far from the plate (View::GatherVeil) and
  /// takes it where it is clearly known better so. How the veil varies over the plate stays as it
  /// is. Returns the number of rays.
  std::size_t Gather(const View& view, const Sign& sign, const Vec3& eye, int band);

private:
  /// Light of the smoke on the way to a place on the plate: of all but the end of the way, or of
  /// that.
  RayLight Trace(const View& view, const Sign& sign, const Vec3& eye, int band, double u, double v,
    bool far) const;

  /// Length of the far part of a way to the plate [m].
  double FarEnd(double distance) const { return std::max(0.0, distance - this->Reach_); }

  const PlateColumns& Columns_;
  const PlateColumns& Rows_;
  double Reach_ = 0.0;
  std::array<std::array<RayLight, 3>, 3> Far_;
  /// Mean over each column of each row.
  std::vector<Lanes> Near_;
};

/// Veil before what shows of a plate that is partly hidden, in one band: rays past what hides it
/// would tell of smoke that is not seen.
class ShownVeil
{
public:
  /// A ray goes to each place.
  /// @param weights of the places in the veil's level
  ShownVeil(const View& view, const Vec3& eye, int band, const std::vector<Vec3>& places,
    const std::vector<double>& weights);

  /// The batches of the veil before one of the places [cd/m2].
  Lanes At(std::size_t place) const;

  /// As PlateVeil::Gather, of the whole ways.
  std::size_t Gather(const View& view, const Vec3& eye, int band);

private:
  std::vector<SightLine> Lines_;
  std::vector<RayLight> Lights_;
};

} // namespace smokevis
