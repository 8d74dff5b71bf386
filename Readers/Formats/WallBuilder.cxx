#include "WallBuilder.h"

#include "SolidCells.h"
#include "WallPlane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

// A surface name that FDS reserves.
constexpr const char* MirrorSurface = "MIRROR";

} // namespace

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

} // namespace smokevis
