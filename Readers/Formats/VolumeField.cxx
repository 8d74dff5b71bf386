#include "VolumeField.h"

#include <algorithm>

namespace smokevis
{

namespace
{

// FDS averages .s3d over all eight cells of a node, solid ones counting as clear. This takes them
// out again: what the node has above clear, times eight over the number of gas cells. Beyond the
// mesh's ends the cells are taken to be like those within.
void TakeSolidsOut(const SmvMesh& mesh, const std::vector<unsigned char>& solid, double clear,
  std::vector<float>& nodes)
{
  if (solid.empty())
  {
    return;
  }
  const std::array<int, 3> cells{mesh.Cells(0), mesh.Cells(1), mesh.Cells(2)};
  const auto row = static_cast<std::size_t>(cells[0]) + 1;
  const std::size_t layer = row * (static_cast<std::size_t>(cells[1]) + 1);
  std::vector<unsigned char> solidCells(nodes.size(), 0);
  std::size_t cell = 0;
  for (int k = 0; k < cells[2]; ++k)
  {
    for (int j = 0; j < cells[1]; ++j)
    {
      for (int i = 0; i < cells[0]; ++i, ++cell)
      {
        if (solid[cell] == 0)
        {
          continue;
        }
        for (int corner = 0; corner < 8; ++corner)
        {
          const std::array<int, 3> node{i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)};
          unsigned char times = 1;
          for (int axis = 0; axis < 3; ++axis)
          {
            times = node[axis] == 0 || node[axis] == cells[axis] ? 2 * times : times;
          }
          const std::size_t place = node[2] * layer + node[1] * row + node[0];
          solidCells[place] = static_cast<unsigned char>(solidCells[place] + times);
        }
      }
    }
  }
  const auto base = static_cast<float>(clear);
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    const int gas = 8 - solidCells[node];
    if (gas < 8)
    {
      nodes[node] =
        gas == 0 ? base : base + (nodes[node] - base) * (8.0F / static_cast<float>(gas));
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
VolumeField::VolumeField(const SmvFile& index, SmokeCandidate candidate)
    : mesh_(index.Meshes[candidate.Mesh]), of_(std::move(candidate)),
      file_(OpenCandidate(index, of_)), times_(file_->FrameTimes())
{
}

//------------------------------------------------------------------------------------------------
void VolumeField::ReadFrame(
  std::size_t frame, const std::vector<unsigned char>& solid, std::vector<float>& values)
{
  file_->ReadStored(frame, values);
  if (of_.Kind == SmokeCandidate::Format::Smoke3D)
  {
    TakeSolidsOut(
      mesh_, solid, of_.Quantity == SmokeQuantity::Other ? of_.ByteRange[0] : 0.0, values);
  }
}

//------------------------------------------------------------------------------------------------
std::size_t VolumeField::CellAt(int j, int k) const
{
  return (static_cast<std::size_t>(k) * mesh_.Cells(1) + j) * mesh_.Cells(0) + of_.Range[0];
}

//------------------------------------------------------------------------------------------------
bool VolumeField::CopyFrame(std::size_t frame, std::vector<float>& scratch, std::span<float> cells)
{
  const auto stride = static_cast<std::size_t>(mesh_.Cells(0));
  bool good = true;
  this->ForEachLayer(
    frame, {}, scratch, [](std::span<float>) {},
    [&](int k, const StoredRows& rows)
    {
      float* const target = cells.data() + this->CellAt(of_.Range[2], k);
      good = (of_.CellCentred ? CopyExtinction(rows, target, stride)
                              : CopyExtinctionOfNodes(rows, target, stride)) &&
             good;
    });
  return good;
}

//------------------------------------------------------------------------------------------------
double VolumeField::ReadCells(double time, TimeInterpolation interpolation,
  const std::vector<unsigned char>& solid, std::vector<float>& scratch, std::span<float> cells)
{
  const FrameMix mix = times_.At(time, interpolation);
  for (std::size_t part = 0; part < 2 && (part == 0 || mix.Weight[part] > 0.0); ++part)
  {
    const auto weight = static_cast<float>(mix.Weight[part]);
    this->ForEachRow(
      mix.Frame[part], solid, scratch, [](std::span<float>) {},
      [&](std::size_t cell, int, int, std::span<const float> row)
      {
        for (std::size_t i = 0; i < row.size(); ++i)
        {
          if (solid.empty() || solid[cell + i] == 0)
          {
            cells[cell + i] = part == 0 ? weight * row[i] : cells[cell + i] + weight * row[i];
          }
        }
      });
  }
  return mix.Time;
}

} // namespace smokevis
