#include "SolidCells.h"

#include <algorithm>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
double Opacity(const SmvFile& index, const SmvObstruction& obstruction)
{
  if (obstruction.Invisible)
  {
    return 0.0;
  }
  if (obstruction.Color)
  {
    return (*obstruction.Color)[3];
  }
  double opacity = 0.0;
  for (const int surface : obstruction.Surfaces)
  {
    opacity = std::max(opacity, index.Surfaces[surface].Color[3]);
  }
  return opacity;
}

//------------------------------------------------------------------------------------------------
std::vector<int> PresentObstructions(
  const SmvFile& index, int mesh, double time, double leastOpacity)
{
  std::vector<int> present;
  const std::vector<SmvObstruction>& obstructions = index.Meshes[mesh].Obstructions;
  for (std::size_t i = 0; i < obstructions.size(); ++i)
  {
    if (IsOn(obstructions[i].Events, time) && Opacity(index, obstructions[i]) >= leastOpacity)
    {
      present.push_back(static_cast<int>(i));
    }
  }
  return present;
}

//------------------------------------------------------------------------------------------------
std::vector<unsigned char> SolidCells(const SmvMesh& mesh, const std::vector<int>& obstructions)
{
  const auto nx = static_cast<std::size_t>(mesh.Cells(0));
  const auto ny = static_cast<std::size_t>(mesh.Cells(1));
  const auto nz = static_cast<std::size_t>(mesh.Cells(2));
  std::vector<unsigned char> solid;
  for (const int i : obstructions)
  {
    const IndexRange& r = mesh.Obstructions[i].Range;
    if (r[0] == r[1] || r[2] == r[3] || r[4] == r[5])
    {
      continue;
    }
    if (solid.empty())
    {
      solid.resize(nx * ny * nz, 0);
    }
    for (int z = r[4]; z < r[5]; ++z)
    {
      for (int y = r[2]; y < r[3]; ++y)
      {
        std::fill_n(solid.begin() + static_cast<std::ptrdiff_t>((z * ny + y) * nx + r[0]),
          r[1] - r[0], static_cast<unsigned char>(1));
      }
    }
  }
  return solid;
}

} // namespace smokevis
