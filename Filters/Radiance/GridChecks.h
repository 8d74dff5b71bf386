// Whether a grid of smoke can be computed with.
#pragma once

namespace smokevis
{

struct SmokeGrid;

/// Throws Error, which names the grid and the axis or cell, where nodes do not ascend, values are
/// missing, negative or infinite, or smoke is denser than can be computed.
void CheckGrid(const SmokeGrid& grid);

} // namespace smokevis
