// What the plate of a sign shows, averaged exactly over blocks of it and pixels of an image.
#pragma once

#include "Types.h"

#include <vector>

namespace smokevis
{

/// Values that a place on a plate has: 1, then its luminance and its reflectance in each band.
inline constexpr int PatternValues = 1 + 2 * MaxBands;
using PatternVector = std::array<double, PatternValues>;

/// A convex cell of a plate, in coordinates that are 0 to 1 along the plate's edges.
struct PatternCell
{
  std::vector<glm::dvec2> Corners;
  PatternVector Value{};
  bool Lit = false;
};

/// The middle of what a block holds of a cell, its area, and the cell's index.
struct PatternPlace
{
  glm::dvec2 At{0.0};
  double Area = 0.0;
  std::size_t Cell = 0;
};

/// Intervals that an edge of the plate is cut into.
struct PatternAxis
{
  /// Ends of the pieces, ascending. A piece lies in one block and in one pixel.
  std::vector<double> Ends;
  /// Of each piece.
  std::vector<std::size_t> Block, Pixel;
  std::size_t Blocks = 0;
  std::size_t Pixels = 0;
  /// Whether every pixel lies in one block.
  bool Fine = true;

  /// @param borders ends of the blocks, from 0 to 1; they give way to the pixels
  /// @param pixels number of pixels of equal size; 0: there are none, each place is one
  PatternAxis(const std::vector<double>& borders, int pixels);

  /// Ends of the blocks; one that no pixel lies in has no width.
  std::vector<double> Borders() const;
};

/// A block of the plate.
struct PatternBlock
{
  /// Area that cells cover, times the values there, of all and of lit cells.
  PatternVector Sum{};
  PatternVector LitSum{};
  /// Sum over its pixels of the products of their mean values, times their area. Only where all
  /// pixels are fine.
  std::array<PatternVector, PatternValues> Products{};
  /// Of the cells that it holds most of, the largest first.
  std::vector<PatternPlace> Places;
};

/// Part of a pixel that is not fine.
struct PatternPiece
{
  std::size_t Block = 0;
  std::size_t Pixel = 0;
  PatternVector Sum{};
};

/// The cells of a plate cut along the pieces of both axes; areas are exact.
class PlatePattern
{
public:
  PlatePattern(
    const std::vector<PatternCell>& cells, const PatternAxis& across, const PatternAxis& up);

  /// Whether Products hold the pixels; else Pieces() do.
  bool Fine() const { return this->Fine_; }
  /// Row after row.
  const std::vector<PatternBlock>& Blocks() const { return this->Blocks_; }
  /// In the order of their pixels.
  const std::vector<PatternPiece>& Pieces() const { return this->Pieces_; }

private:
  void AddPlace(std::size_t block, const PatternPlace& place);
  void AddProducts(std::size_t block, const PatternVector& sum);

  bool Fine_;
  std::vector<PatternBlock> Blocks_;
  std::vector<PatternPiece> Pieces_;
};

} // namespace smokevis
