#include "SmokeImage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace smokevis
{

namespace
{

// Cells along an axis at most: the texture size that every OpenGL 3.2 driver gives in 3-D is less
// than this, but those in use give 2048.
constexpr int MostAlongAxis = 1024;
// Part of an image's cell that is taken for rounding of the coordinates.
constexpr double Sliver = 1e-5;

// The part of an image's cell that a mesh's cell fills, along one axis.
struct Overlap
{
  int Cell;
  double Part;
};

// What a mesh's cells fill of the image's cells along one axis.
class AxisOverlaps
{
public:
  AxisOverlaps(const std::vector<double>& nodes, double origin, double spacing, int first, int end)
      : Starts_{0}
  {
    const int cells = static_cast<int>(nodes.size()) - 1;
    int cell = 0;
    for (int i = first; i < end; ++i)
    {
      const double low = origin + i * spacing;
      const double high = origin + (i + 1) * spacing;
      while (cell < cells && nodes[cell + 1] <= low)
      {
        ++cell;
      }
      for (int j = cell; j < cells && nodes[j] < high; ++j)
      {
        const double part = (std::min(high, nodes[j + 1]) - std::max(low, nodes[j])) / spacing;
        if (part > Sliver)
        {
          this->All_.push_back({j, part > 1.0 - Sliver ? 1.0 : part});
        }
      }
      this->Starts_.push_back(this->All_.size());
      double part = 0.0;
      for (const Overlap* overlap = this->Begin(i - first); overlap != this->End(i - first);
           ++overlap)
      {
        part += overlap->Part;
      }
      this->Parts_.push_back(std::min(part, 1.0));
      if (part > 0.0)
      {
        this->First_ = this->Behind_ > 0 ? this->First_ : i - first;
        this->Behind_ = i - first + 1;
      }
    }
  }

  /// The image's cells that the mesh fills at least a part of: from First() to before Behind().
  int First() const { return this->First_; }
  int Behind() const { return this->Behind_; }

  const Overlap* Begin(int i) const { return this->All_.data() + this->Starts_[i]; }
  const Overlap* End(int i) const { return this->All_.data() + this->Starts_[i + 1]; }

  /// The part of an image's cell that the whole mesh fills.
  double Part(int i) const { return this->Parts_[i]; }

private:
  std::vector<Overlap> All_;
  std::vector<std::size_t> Starts_;
  std::vector<double> Parts_;
  int First_ = 0;
  int Behind_ = 0;
};

// Lays a mesh over what coarser ones have given.
class MeshPainter
{
public:
  MeshPainter(const DrawnMesh& mesh, const Lattice& lattice, const std::array<int, 3>& first,
    const std::array<int, 3>& end)
      : Mesh_(mesh), Along_{Overlaps(mesh, lattice, first, end, 0),
                       Overlaps(mesh, lattice, first, end, 1),
                       Overlaps(mesh, lattice, first, end, 2)}
  {
  }

  const AxisOverlaps& Along(int axis) const { return this->Along_[axis]; }

  /// @param covered what part of the cell meshes have filled so far
  void Paint(int i, int j, int k, float& value, float& covered) const
  {
    const double part = this->Along_[0].Part(i) * this->Along_[1].Part(j) * this->Along_[2].Part(k);
    // Meshes side by side share a cell; the one on top hides what it fills of those below.
    const double kept = covered > 1.0 - part ? (1.0 - part) / covered : 1.0;
    value = static_cast<float>(kept * value + this->Smoke(i, j, k));
    covered = static_cast<float>(std::min(1.0, covered + part));
  }

private:
  static AxisOverlaps Overlaps(const DrawnMesh& mesh, const Lattice& lattice,
    const std::array<int, 3>& first, const std::array<int, 3>& end, int axis)
  {
    return {mesh.Nodes[axis], lattice.Origin[axis], lattice.Spacing[axis], first[axis], end[axis]};
  }

  // The mesh's extinction over the image's cell, times the part that it fills.
  double Smoke(int i, int j, int k) const
  {
    const auto& [x, y, z] = this->Along_;
    double sum = 0.0;
    for (const Overlap* c = z.Begin(k); c != z.End(k); ++c)
    {
      for (const Overlap* b = y.Begin(j); b != y.End(j); ++b)
      {
        const std::size_t row =
          (static_cast<std::size_t>(c->Cell) * this->Mesh_.Cells(1) + b->Cell) *
          this->Mesh_.Cells(0);
        double along = 0.0;
        for (const Overlap* a = x.Begin(i); a != x.End(i); ++a)
        {
          along += a->Part * this->Mesh_.Extinction[row + a->Cell];
        }
        sum += c->Part * b->Part * along;
      }
    }
    return sum;
  }

  const DrawnMesh& Mesh_;
  std::array<AxisOverlaps, 3> Along_;
};

} // namespace

//------------------------------------------------------------------------------
int Lattice::LongestAxis() const
{
  return static_cast<int>(
    std::max_element(this->Cells.begin(), this->Cells.end()) - this->Cells.begin());
}

//------------------------------------------------------------------------------
Lattice LatticeOver(const std::vector<DrawnMesh>& meshes, double most, int layers)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low = {infinity, infinity, infinity};
  std::array<double, 3> high = {-infinity, -infinity, -infinity};
  std::array<double, 3> size = {infinity, infinity, infinity};
  for (const DrawnMesh& mesh : meshes)
  {
    for (int axis = 0; axis < 3 && !mesh.Extinction.empty(); ++axis)
    {
      low[axis] = std::min(low[axis], mesh.Nodes[axis].front());
      high[axis] = std::max(high[axis], mesh.Nodes[axis].back());
      size[axis] = std::min(size[axis], mesh.Length(axis) / mesh.Cells(axis));
    }
  }
  Lattice lattice;
  if (!(low[0] < high[0]))
  {
    return lattice;
  }
  std::array<double, 3> cells;
  double all = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] =
      std::clamp(std::round((high[axis] - low[axis]) / size[axis]), 1.0, double(MostAlongAxis));
    all *= cells[axis];
  }
  // Axes that are down to one cell no longer help to make them fewer.
  while (all > most && all > 1.0)
  {
    const double factor = std::min(std::cbrt(most / all), 0.99);
    all = 1.0;
    for (double& along : cells)
    {
      along = std::max(1.0, std::floor(factor * along));
      all *= along;
    }
  }
  double& longest = *std::max_element(cells.begin(), cells.end());
  longest = std::max(longest, double(layers));
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.Cells[axis] = static_cast<int>(cells[axis]);
    lattice.Origin[axis] = low[axis];
    lattice.Spacing[axis] = (high[axis] - low[axis]) / cells[axis];
  }
  return lattice;
}

//------------------------------------------------------------------------------
std::vector<float> SampleSmoke(const std::vector<DrawnMesh>& meshes, const Lattice& lattice,
  const std::array<int, 3>& first, const std::array<int, 3>& end)
{
  std::vector<const DrawnMesh*> coarseFirst;
  for (const DrawnMesh& mesh : meshes)
  {
    if (!mesh.Extinction.empty())
    {
      coarseFirst.push_back(&mesh);
    }
  }
  std::stable_sort(coarseFirst.begin(), coarseFirst.end(),
    [](const DrawnMesh* a, const DrawnMesh* b) { return a->CellVolume() > b->CellVolume(); });

  const std::array<int, 3> size = {end[0] - first[0], end[1] - first[1], end[2] - first[2]};
  const std::size_t cells = static_cast<std::size_t>(size[0]) * size[1] * size[2];
  std::vector<float> values(cells, 0.0F);
  std::vector<float> covered(cells, 0.0F);
  for (const DrawnMesh* mesh : coarseFirst)
  {
    const MeshPainter painter(*mesh, lattice, first, end);
    tbb::parallel_for(painter.Along(2).First(), painter.Along(2).Behind(),
      [&](int k)
      {
        for (int j = painter.Along(1).First(); j < painter.Along(1).Behind(); ++j)
        {
          const std::size_t row = (static_cast<std::size_t>(k) * size[1] + j) * size[0];
          for (int i = painter.Along(0).First(); i < painter.Along(0).Behind(); ++i)
          {
            painter.Paint(i, j, k, values[row + i], covered[row + i]);
          }
        }
      });
  }
  return values;
}

} // namespace smokevis
