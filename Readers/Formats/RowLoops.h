// The inner loops over rows of values, with the widest instructions that the machine has.
#pragma once

#include <cstddef>
#include <span>

namespace smokevis
{

/// More negative than this [1/m] is no rounding of a transport scheme but not smoke at all.
constexpr float MostNegativeExtinction = -1e-3F;

/// Whether a value can be an extinction coefficient [1/m].
bool IsExtinction(float value);

/// A layer of cells as a file has it: a value a cell, or at the nodes in between, of which there
/// are one more row and one more in a row, and another such layer above.
struct StoredRows
{
  const float* First = nullptr;
  /// Values from one row to the next, and from one layer to the next.
  std::size_t Stride = 0;
  std::size_t Layer = 0;
  /// Cells in a row, and rows of cells.
  std::size_t Cells = 0;
  std::size_t Rows = 0;
};

/// The means of the eight nodes of each cell of a row. The result does not depend on the machine.
/// @param row the first of the nodes
/// @param stride, layer to the next row and the next layer of nodes
void MeansOfNodes(const float* row, std::size_t stride, std::size_t layer, std::span<float> means);

/// Writes extinction coefficients to @p target, rounding errors below 0 as 0. Returns whether all
/// of them can be ones.
bool CopyExtinction(std::span<const float> values, float* target);

/// The same for a layer of cells. @p targetStride leads from one row to the next in the target.
bool CopyExtinction(const StoredRows& cells, float* target, std::size_t targetStride);

/// The same for the means of nodes: MeansOfNodes() and CopyExtinction() in one.
bool CopyExtinctionOfNodes(const StoredRows& nodes, float* target, std::size_t targetStride);

/// Adds @p weight times extinction coefficients to @p target, else as CopyExtinction().
bool AddExtinction(std::span<const float> values, float weight, float* target);

} // namespace smokevis
