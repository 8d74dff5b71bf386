#include "GridChecks.h"

#include "Errors.h"
#include "Medium.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace smokevis
{

namespace
{

/// Optical depth across a cell beyond which single precision has no digits left for what comes and
/// goes; no smoke is as dense.
constexpr double LargestDepth = 1e12;

void CheckDepths(const SmokeGrid& grid)
{
  const std::size_t across = grid.Nodes[0].size() - 1;
  const std::size_t along = grid.Nodes[1].size() - 1;
  const auto edge = [&grid](int axis, std::size_t index)
  { return grid.Nodes[axis][index + 1] - grid.Nodes[axis][index]; };
  for (std::size_t cell = 0; cell < grid.Extinction.size(); ++cell)
  {
    const std::size_t row = cell / across;
    const double depth = grid.Extinction[cell] * std::max({edge(0, cell % across),
                                                   edge(1, row % along), edge(2, row / along)});
    if (depth > LargestDepth)
    {
      std::ostringstream what;
      what << "the extinction coefficient is " << grid.Extinction[cell]
           << " 1/m, an optical depth of " << depth << " across the cell";
      throw Error("smoke grid '" + grid.Name + "', cell " + std::to_string(cell), what.str(),
        "Check its unit: 1e12 across a cell is the most that can be computed");
    }
  }
}

} // namespace

void CheckGrid(const SmokeGrid& grid)
{
  std::size_t cells = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& nodes = grid.Nodes[axis];
    const std::string where = "smoke grid '" + grid.Name + "', axis " + "xyz"[axis];
    if (nodes.size() < 2)
    {
      throw Error(where, "the grid has no cells along this axis", "Give at least two node planes");
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      if (!std::isfinite(nodes[i]) || (i > 0 && nodes[i] <= nodes[i - 1]))
      {
        throw Error(where, "node " + std::to_string(i) + " does not lie above the one before it",
          "Node coordinates must be finite and strictly increasing");
      }
    }
    cells *= nodes.size() - 1;
  }
  if (grid.Extinction.size() != cells)
  {
    throw Error("smoke grid '" + grid.Name + "'",
      "there are " + std::to_string(grid.Extinction.size()) + " extinction values for " +
        std::to_string(cells) + " cells",
      "Give one value a cell");
  }
  if (!grid.EmittedLuminance.empty() && grid.EmittedLuminance.size() != cells)
  {
    throw Error("smoke grid '" + grid.Name + "'", "emitted luminance is not given for every cell",
      "Give one value a cell, or none at all");
  }
  const auto check = [&](const std::vector<float>& values, const char* quantity)
  {
    for (std::size_t cell = 0; cell < values.size(); ++cell)
    {
      if (!(values[cell] >= 0.0F) || std::isinf(values[cell]))
      {
        throw Error("smoke grid '" + grid.Name + "', cell " + std::to_string(cell),
          std::string(quantity) + " is " + std::to_string(values[cell]),
          "It must be finite and not negative");
      }
    }
  };
  check(grid.Extinction, "the extinction coefficient");
  check(grid.EmittedLuminance, "the emitted luminance");
  CheckDepths(grid);
}

} // namespace smokevis
