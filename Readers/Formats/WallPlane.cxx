// The planes of the wall builder: which are needed, their faces, what is painted on them, and how
// faces merge into rectangles.
#include "WallPlane.h"

#include <algorithm>
#include <cmath>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
bool IsOpening(const std::string& surface)
{
  return surface == "OPEN" || surface == "INTERPOLATED" || surface.starts_with("PERIODIC");
}

//------------------------------------------------------------------------------------------------
int CellAt(const std::vector<double>& nodes, double x)
{
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
  const auto cell = static_cast<int>(above - nodes.begin()) - 1;
  return std::clamp(cell, 0, static_cast<int>(nodes.size()) - 2);
}

//------------------------------------------------------------------------------------------------
std::vector<int> WallBuilder::Neighbours(int block, int axis, int k) const
{
  const SmvMesh& mesh = *blocks_[block].Mesh;
  const double coordinate = mesh.Nodes[axis][k];
  std::vector<int> neighbours;
  for (int other = 0; other < static_cast<int>(blocks_.size()); ++other)
  {
    const SmvMesh& candidate = *blocks_[other].Mesh;
    const double tolerance = std::max(blocks_[block].Tolerance, blocks_[other].Tolerance);
    bool touches = other != block && coordinate > candidate.Nodes[axis].front() - tolerance &&
                   coordinate < candidate.Nodes[axis].back() + tolerance;
    for (int tangent = 0; tangent < 3 && touches; ++tangent)
    {
      touches = tangent == axis ||
                std::min(mesh.Nodes[tangent].back(), candidate.Nodes[tangent].back()) -
                    std::max(mesh.Nodes[tangent].front(), candidate.Nodes[tangent].front()) >
                  tolerance;
    }
    if (touches)
    {
      neighbours.push_back(other);
    }
  }
  return neighbours;
}

//------------------------------------------------------------------------------------------------
bool WallBuilder::NeedsPlane(int block, int axis, int k, const std::vector<int>& neighbours) const
{
  const Block& own = blocks_[block];
  if (k == 0 || k == own.Mesh->Cells(axis))
  {
    return true;
  }
  const auto touches = [&](int i)
  {
    const IndexRange& range = own.Mesh->Obstructions[i].Range;
    return range[2 * axis] == k || range[2 * axis + 1] == k;
  };
  // Gas of this mesh may also end where an overlapping mesh begins.
  const auto begins = [&](int other)
  {
    const std::vector<double>& nodes = blocks_[other].Mesh->Nodes[axis];
    const double coordinate = own.Mesh->Nodes[axis][k];
    return std::abs(nodes.front() - coordinate) <= own.Tolerance ||
           std::abs(nodes.back() - coordinate) <= own.Tolerance;
  };
  return std::any_of(own.Obstructions.begin(), own.Obstructions.end(), touches) ||
         std::any_of(neighbours.begin(), neighbours.end(), begins);
}

//------------------------------------------------------------------------------------------------
void WallBuilder::Refine(Plane& plane, const std::vector<int>& neighbours) const
{
  const Block& own = blocks_[plane.Block];
  for (const int side : {0, 1})
  {
    const int axis = side == 0 ? plane.B : plane.D;
    const std::vector<double>& nodes = own.Mesh->Nodes[axis];
    std::vector<double> lines = nodes;
    for (const int other : neighbours)
    {
      for (const double line : blocks_[other].Mesh->Nodes[axis])
      {
        const auto above = std::lower_bound(nodes.begin(), nodes.end(), line);
        const bool inside = above != nodes.begin() && above != nodes.end();
        if (inside && *above - line > own.Tolerance && line - *(above - 1) > own.Tolerance)
        {
          lines.push_back(line);
        }
      }
    }
    std::sort(lines.begin(), lines.end());
    // Two meshes on the other side may add the same line twice; this mesh's own lines stay.
    std::vector<double> distinct;
    for (const double line : lines)
    {
      if (distinct.empty() || line - distinct.back() > own.Tolerance)
      {
        distinct.push_back(line);
      }
    }
    plane.Lines[side] = std::move(distinct);
    for (std::size_t i = 0; i + 1 < plane.Lines[side].size(); ++i)
    {
      plane.Cells[side].push_back(
        CellAt(nodes, 0.5 * (plane.Lines[side][i] + plane.Lines[side][i + 1])));
    }
  }
}

//------------------------------------------------------------------------------------------------
void WallBuilder::PaintObstructions(Plane& plane) const
{
  const Block& own = blocks_[plane.Block];
  const auto nb = static_cast<std::size_t>(own.Mesh->Cells(plane.B));
  const auto nd = static_cast<std::size_t>(own.Mesh->Cells(plane.D));
  plane.Obstruction = {std::vector<int>(nb * nd, None), std::vector<int>(nb * nd, None)};
  plane.Plate.assign(nb * nd, 0);
  // Where obstructions share a face FDS lets the one listed last have it.
  for (const int i : own.Obstructions)
  {
    const IndexRange& r = own.Mesh->Obstructions[i].Range;
    const bool low = r[2 * plane.Axis] == plane.K;
    const bool high = r[2 * plane.Axis + 1] == plane.K;
    if (!low && !high)
    {
      continue;
    }
    for (int d = r[2 * plane.D]; d < r[2 * plane.D + 1]; ++d)
    {
      for (int b = r[2 * plane.B]; b < r[2 * plane.B + 1]; ++b)
      {
        const std::size_t face = static_cast<std::size_t>(d) * nb + b;
        if (low)
        {
          plane.Obstruction[0][face] = i;
        }
        if (high)
        {
          plane.Obstruction[1][face] = i;
        }
        if (low && high)
        {
          plane.Plate[face] = 1;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
void WallBuilder::PaintVents(Plane& plane)
{
  const SmvMesh& mesh = *blocks_[plane.Block].Mesh;
  const auto nb = static_cast<std::size_t>(mesh.Cells(plane.B));
  const auto nd = static_cast<std::size_t>(mesh.Cells(plane.D));
  plane.Vent = {std::vector<int>(nb * nd, None), std::vector<int>(nb * nd, None)};
  for (std::size_t i = 0; i < mesh.Vents.size(); ++i)
  {
    const SmvVent& vent = mesh.Vents[i];
    const IndexRange& r = vent.Range;
    const std::string& surface = index_.Surfaces[vent.Surface].Name;
    const bool closedOpening = IsOpening(surface) && !IsOn(vent.Events, time_);
    if (r[2 * plane.Axis] != plane.K || r[2 * plane.Axis + 1] != plane.K || closedOpening)
    {
      continue;
    }
    for (int d = r[2 * plane.D]; d < r[2 * plane.D + 1]; ++d)
    {
      for (int b = r[2 * plane.B]; b < r[2 * plane.B + 1]; ++b)
      {
        if (vent.Circle)
        {
          const auto& [x, y, z, radius] = *vent.Circle;
          const std::array<double, 3> centre{x, y, z};
          const std::vector<double>& bNodes = mesh.Nodes[plane.B];
          const std::vector<double>& dNodes = mesh.Nodes[plane.D];
          if (std::hypot(0.5 * (bNodes[b] + bNodes[b + 1]) - centre[plane.B],
                0.5 * (dNodes[d] + dNodes[d + 1]) - centre[plane.D]) > radius)
          {
            continue;
          }
        }
        const std::size_t face = static_cast<std::size_t>(d) * nb + b;
        for (const int side : {0, 1})
        {
          const bool otherWay = vent.Orientation != 0 && (vent.Orientation > 0) != (side == 1);
          // Of vents on one face FDS takes the first.
          if (!otherWay && plane.Vent[side][face] == None)
          {
            plane.Vent[side][face] = static_cast<int>(i);
          }
        }
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
void WallBuilder::Merge(const Plane& plane, bool positive, std::vector<WallQuad>& quads)
{
  std::vector<int> left = plane.Material[positive ? 1 : 0];
  const int nb = static_cast<int>(plane.Lines[0].size()) - 1;
  const int nd = static_cast<int>(plane.Lines[1].size()) - 1;
  for (int d = 0; d < nd; ++d)
  {
    for (int b = 0; b < nb; ++b)
    {
      const int material = left[plane.Face(b, d)];
      if (material == None)
      {
        continue;
      }
      int bEnd = b + 1;
      while (bEnd < nb && left[plane.Face(bEnd, d)] == material)
      {
        ++bEnd;
      }
      int dEnd = d + 1;
      const auto wholeRow = [&](int row)
      {
        const auto begin = left.begin() + static_cast<std::ptrdiff_t>(plane.Face(b, row));
        return std::all_of(begin, begin + (bEnd - b), [&](int m) { return m == material; });
      };
      while (dEnd < nd && wholeRow(dEnd))
      {
        ++dEnd;
      }
      for (int row = d; row < dEnd; ++row)
      {
        std::fill_n(left.begin() + static_cast<std::ptrdiff_t>(plane.Face(b, row)), bEnd - b, None);
      }
      WallQuad quad;
      quad.Axis = plane.Axis;
      quad.Positive = positive;
      quad.Material = material;
      quad.Low[plane.Axis] = quad.High[plane.Axis] = plane.Coordinate;
      quad.Low[plane.B] = plane.Lines[0][b];
      quad.High[plane.B] = plane.Lines[0][bEnd];
      quad.Low[plane.D] = plane.Lines[1][d];
      quad.High[plane.D] = plane.Lines[1][dEnd];
      quads.push_back(quad);
    }
  }
}

} // namespace smokevis
