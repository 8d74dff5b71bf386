// The rectangle around a sign's plate, and the columns and rows of its pattern.
#pragma once

#include "Emitters.h"

#include <vector>

namespace smokevis
{

/// A place on the rectangle around a sign, 0 to 1 along both edges.
Vec3 OnPlate(const Sign& sign, double u, double v);
glm::dvec2 PlaceOnPlate(const Sign& sign, const Vec3& point);

/// Columns (or rows) of a sign's pattern along one edge of the plate.
struct PlateColumns
{
  /// Where they begin and end, 0 to 1.
  std::vector<double> Ends;
  double Widest = 1.0;

  /// @param borders where cells begin and end, in any order; a pattern with too many of them to be
  /// told apart in the smoke's glow counts as one column
  explicit PlateColumns(std::vector<double> borders);
  /// Those along an edge: 0 from the first corner to the second, 1 from the first to the last.
  PlateColumns(const EmitterSet& lights, const Sign& sign, int edge);

  std::size_t Count() const { return this->Ends.size() - 1; }
  std::size_t Of(double t) const;
  /// The two Gauss points of a column.
  double Node(std::size_t column, int index) const;
  /// Where a place lies between them, 0 at the first and 1 at the second.
  double Between(std::size_t column, double t) const;
  /// The same with further borders inside columns.
  PlateColumns DividedAt(const std::vector<double>& borders) const;
  /// The same with each in two halves.
  PlateColumns Halved() const;

  /// What lies in one column of a stretch.
  struct Piece
  {
    std::size_t Column;
    /// Of the stretch.
    double Share;
    double Begin, End;
    double Middle() const { return 0.5 * (this->Begin + this->End); }
  };
  /// The pieces of a stretch; of one without a length the column that it lies in.
  std::vector<Piece> PiecesOf(double middle, double length) const;
};

} // namespace smokevis
