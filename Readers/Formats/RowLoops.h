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

/// Adds two rows: sums[i] = nearer[i] + farther[i].
void AddRows(const float* nearer, const float* farther, std::span<float> sums);

/// The means of the eight nodes of each cell of a row. The result does not depend on the machine.
/// @param before, sums of two rows of nodes each, below and above each other, one more than cells
void MeansOfNodes(const float* before, const float* sums, std::span<float> means);

/// MeansOfNodes() and CopyExtinction() in one.
bool CopyExtinctionOfNodes(
  const float* before, const float* sums, std::size_t cells, float* target);

/// Writes extinction coefficients to @p target, rounding errors below 0 as 0. Returns whether all
/// of them can be ones.
bool CopyExtinction(std::span<const float> values, float* target);

/// Adds @p weight times extinction coefficients to @p target, else as CopyExtinction().
bool AddExtinction(std::span<const float> values, float weight, float* target);

} // namespace smokevis
