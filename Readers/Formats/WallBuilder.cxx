#include "WallBuilder.h"

#include "SolidCells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

constexpr int None = -1;
// Surface names that FDS reserves.
constexpr const char* MirrorSurface = "MIRROR";

// Whether a vent of this surface is no wall: light leaves the domain there.
bool IsOpening(const std::string& surface)
{
  return surface == "OPEN" || surface == "INTERPOLATED" || surface.starts_with("PERIODIC");
}

// The cell of increasing nodes that holds x; x beyond the ends belongs to the end cells.
int CellAt(const std::vector<double>& nodes, double x)
{
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
  const auto cell = static_cast<int>(above - nodes.begin()) - 1;
  return std::clamp(cell, 0, static_cast<int>(nodes.size()) - 2);
}

} // namespace

//------------------------------------------------------------------------------------------------
struct WallBuilder::Plane
{
  int Block = 0;
  int Axis = 0;
  int K = 0;
  /// The tangential axes, so that B x D = Axis.
  int B = 0;
  int D = 0;
  double Coordinate = 0.0;
  /// Grid lines across B and D, and the mesh's own cell between each two of them.
  std::array<std::vector<double>, 2> Lines;
  std::array<std::vector<int>, 2> Cells;
  /// A face of the mesh each, B fastest, for the normals along -axis [0] and +axis [1]: the
  /// obstruction and the vent that lie in it, and whether the obstruction is a plate.
  std::array<std::vector<int>, 2> Obstruction;
  std::array<std::vector<int>, 2> Vent;
  std::vector<unsigned char> Plate;
  /// A material each refined face, or None.
  std::array<std::vector<int>, 2> Material;

  std::size_t Face(int b, int d) const
  {
    return static_cast<std::size_t>(d) * (Lines[0].size() - 1) + static_cast<std::size_t>(b);
  }
};

//------------------------------------------------------------------------------------------------
struct WallBuilder::Side
{
  /// The mesh that the point belongs to, or None outside of all.
  int Block = None;
  bool Solid = false;
  std::array<int, 3> Cell{};

  bool Gas() const { return Block != None && !Solid; }
};

//------------------------------------------------------------------------------------------------
double LinearFromSrgb(double part)
{
  return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
}

//------------------------------------------------------------------------------------------------
std::array<std::array<double, 3>, 4> WallQuad::Corners() const
{
  const int b = (Axis + 1) % 3;
  const int d = (Axis + 2) % 3;
  std::array<std::array<double, 3>, 4> corners{Low, Low, High, Low};
  corners[1][b] = High[b];
  corners[3][d] = High[d];
  if (!Positive)
  {
    std::swap(corners[1], corners[3]);
  }
  return corners;
}

//------------------------------------------------------------------------------------------------
WallBuilder::WallBuilder(const SmvFile& index, double time, double leastOpacity)
    : index_(index), time_(time)
{
  for (std::size_t i = 0; i < index.Meshes.size(); ++i)
  {
    Block block;
    block.Mesh = &index.Meshes[i];
    block.Obstructions = PresentObstructions(index, static_cast<int>(i), time, leastOpacity);
    block.Solid = SolidCells(*block.Mesh, block.Obstructions);
    block.CellVolume = 1.0;
    double thinnest = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& nodes = block.Mesh->Nodes[axis];
      block.CellVolume *= (nodes.back() - nodes.front()) / block.Mesh->Cells(axis);
      for (std::size_t n = 1; n < nodes.size(); ++n)
      {
        thinnest = std::min(thinnest, nodes[n] - nodes[n - 1]);
      }
    }
    // The index rounds coordinates to 1e-5 m.
    block.Tolerance = std::min(2e-5 + 1e-3 * thinnest, 0.1 * thinnest);
    blocks_.push_back(std::move(block));
  }
}

//------------------------------------------------------------------------------------------------
std::vector<WallQuad> WallBuilder::Build()
{
  std::vector<WallQuad> quads;
  for (std::size_t block = 0; block < blocks_.size(); ++block)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int k = 0; k <= blocks_[block].Mesh->Cells(axis); ++k)
      {
        this->AddPlane(static_cast<int>(block), axis, k, quads);
      }
    }
  }
  return quads;
}

//------------------------------------------------------------------------------------------------
void WallBuilder::AddPlane(int block, int axis, int k, std::vector<WallQuad>& quads)
{
  const std::vector<int> neighbours = this->Neighbours(block, axis, k);
  if (!this->NeedsPlane(block, axis, k, neighbours))
  {
    return;
  }
  Plane plane;
  plane.Block = block;
  plane.Axis = axis;
  plane.K = k;
  plane.B = (axis + 1) % 3;
  plane.D = (axis + 2) % 3;
  plane.Coordinate = blocks_[block].Mesh->Nodes[axis][k];
  this->Refine(plane, neighbours);
  this->PaintObstructions(plane);
  this->PaintVents(plane);
  const std::size_t faces = (plane.Lines[0].size() - 1) * (plane.Lines[1].size() - 1);
  plane.Material = {std::vector<int>(faces, None), std::vector<int>(faces, None)};
  for (int d = 0; d + 1 < static_cast<int>(plane.Lines[1].size()); ++d)
  {
    for (int b = 0; b + 1 < static_cast<int>(plane.Lines[0].size()); ++b)
    {
      this->AddFace(plane, b, d, neighbours);
    }
  }
  Merge(plane, false, quads);
  Merge(plane, true, quads);
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
WallBuilder::Side WallBuilder::Look(
  const Plane& plane, int b, int d, bool positive, const std::vector<int>& neighbours) const
{
  const Block& own = blocks_[plane.Block];
  const std::vector<double>& nodes = own.Mesh->Nodes[plane.Axis];
  Side side;
  const int cell = positive ? plane.K : plane.K - 1;
  if (cell >= 0 && cell < own.Mesh->Cells(plane.Axis))
  {
    side.Block = plane.Block;
    side.Cell[plane.Axis] = cell;
    side.Cell[plane.B] = plane.Cells[0][b];
    side.Cell[plane.D] = plane.Cells[1][d];
  }
  if (!neighbours.empty())
  {
    // A point a little way off the face, within the first cell of any mesh there.
    const int nearest = std::clamp(cell, 0, own.Mesh->Cells(plane.Axis) - 1);
    const double step = std::max(0.02 * (nodes[nearest + 1] - nodes[nearest]), 2 * own.Tolerance);
    std::array<double, 3> point{};
    point[plane.Axis] = plane.Coordinate + (positive ? step : -step);
    point[plane.B] = 0.5 * (plane.Lines[0][b] + plane.Lines[0][b + 1]);
    point[plane.D] = 0.5 * (plane.Lines[1][d] + plane.Lines[1][d + 1]);
    for (const int other : neighbours)
    {
      const SmvMesh& mesh = *blocks_[other].Mesh;
      bool inside = true;
      for (int axis = 0; axis < 3 && inside; ++axis)
      {
        inside = point[axis] > mesh.Nodes[axis].front() && point[axis] < mesh.Nodes[axis].back();
      }
      const bool finer =
        side.Block == None || blocks_[other].CellVolume < 0.999 * blocks_[side.Block].CellVolume ||
        (blocks_[other].CellVolume < 1.001 * blocks_[side.Block].CellVolume && other < side.Block);
      if (inside && finer)
      {
        side.Block = other;
        for (int axis = 0; axis < 3; ++axis)
        {
          side.Cell[axis] = CellAt(mesh.Nodes[axis], point[axis]);
        }
      }
    }
  }
  if (side.Block != None && !blocks_[side.Block].Solid.empty())
  {
    const Block& owner = blocks_[side.Block];
    const auto nx = static_cast<std::size_t>(owner.Mesh->Cells(0));
    const auto ny = static_cast<std::size_t>(owner.Mesh->Cells(1));
    side.Solid = owner.Solid[(side.Cell[2] * ny + side.Cell[1]) * nx + side.Cell[0]] != 0;
  }
  return side;
}

//------------------------------------------------------------------------------------------------
void WallBuilder::AddFace(Plane& plane, int b, int d, const std::vector<int>& neighbours)
{
  const Side low = this->Look(plane, b, d, false, neighbours);
  const Side high = this->Look(plane, b, d, true, neighbours);
  const std::size_t ownFace =
    static_cast<std::size_t>(plane.Cells[1][d]) * blocks_[plane.Block].Mesh->Cells(plane.B) +
    static_cast<std::size_t>(plane.Cells[0][b]);
  if (low.Gas() && high.Gas())
  {
    // A plate of zero thickness. Where two meshes meet both have it: the finer one gives the face.
    const bool lowOwns = low.Block == high.Block ||
                         blocks_[low.Block].CellVolume < 0.999 * blocks_[high.Block].CellVolume ||
                         (blocks_[low.Block].CellVolume < 1.001 * blocks_[high.Block].CellVolume &&
                           low.Block < high.Block);
    const int owner = lowOwns ? low.Block : high.Block;
    if (plane.Plate[ownFace] != 0 && owner == plane.Block)
    {
      plane.Material[1][plane.Face(b, d)] = this->FaceMaterial(plane, ownFace, true, low);
    }
    return;
  }
  if (low.Gas() && low.Block == plane.Block)
  {
    plane.Material[0][plane.Face(b, d)] = this->FaceMaterial(plane, ownFace, false, high);
  }
  if (high.Gas() && high.Block == plane.Block)
  {
    plane.Material[1][plane.Face(b, d)] = this->FaceMaterial(plane, ownFace, true, low);
  }
}

//------------------------------------------------------------------------------------------------
int WallBuilder::FaceMaterial(
  const Plane& plane, std::size_t face, bool positive, const Side& behind)
{
  const Block& own = blocks_[plane.Block];
  const int side = positive ? 1 : 0;
  const int obstruction = plane.Obstruction[side][face];
  const int vent = plane.Vent[side][face];
  if (vent != None)
  {
    const SmvVent& cover = own.Mesh->Vents[vent];
    const std::string& name = index_.Surfaces[cover.Surface].Name;
    if (!IsOpening(name))
    {
      foundMirror_ = foundMirror_ || name == MirrorSurface;
      return this->MaterialOf(cover.Surface, cover.Color ? &*cover.Color : nullptr);
    }
    if (behind.Block == None && obstruction == None)
    {
      return None;
    }
  }
  if (behind.Solid && behind.Block != plane.Block)
  {
    // The mesh that the solid belongs to knows best what it is.
    const Block& other = blocks_[behind.Block];
    for (auto i = other.Obstructions.rbegin(); i != other.Obstructions.rend(); ++i)
    {
      const SmvObstruction& solid = other.Mesh->Obstructions[*i];
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        inside = inside && behind.Cell[axis] >= solid.Range[2 * axis] &&
                 behind.Cell[axis] < solid.Range[2 * axis + 1];
      }
      if (inside)
      {
        return this->MaterialOf(solid, plane.Axis, positive);
      }
    }
  }
  if (obstruction != None)
  {
    return this->MaterialOf(own.Mesh->Obstructions[obstruction], plane.Axis, positive);
  }
  return this->MaterialOf(index_.DefaultSurface(), nullptr);
}

//------------------------------------------------------------------------------------------------
int WallBuilder::MaterialOf(const SmvObstruction& obstruction, int axis, bool positive)
{
  return this->MaterialOf(obstruction.Surfaces[2 * axis + (positive ? 1 : 0)],
    obstruction.Color ? &*obstruction.Color : nullptr);
}

//------------------------------------------------------------------------------------------------
int WallBuilder::MaterialOf(int surface, const std::array<double, 4>* own)
{
  const std::array<double, 4>& color = own ? *own : index_.Surfaces[surface].Color;
  const WallMaterial material{surface, {color[0], color[1], color[2]}};
  const auto found = std::find(materials_.begin(), materials_.end(), material);
  if (found != materials_.end())
  {
    return static_cast<int>(found - materials_.begin());
  }
  materials_.push_back(material);
  return static_cast<int>(materials_.size()) - 1;
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
