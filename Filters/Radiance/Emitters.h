// Plates of signs and lamps, and the light that reaches a point straight from them.
#pragma once

#include "Types.h"

#include <string>
#include <vector>

namespace smokevis
{

class Geometry;
class Medium;

/// One plane convex polygon of a sign's or lamp's plate. It emits from its front (right-hand side)
/// only, luminance times cos^Exponent of the angle to the normal (0: Lambertian).
struct EmitterCell
{
  std::vector<Vec3> Vertices;
  Spectrum Luminance{};
  double Exponent = 0.0;
  Spectrum Reflectance{};
  /// Cells of one sign share an id >= 0; -1: a lamp.
  int SignId = -1;
};

/// A sign: emitter cells with one id.
struct Sign
{
  int Id = 0;
  /// Indices of its cells.
  std::vector<std::size_t> Cells;
  Vec3 Centre{ 0.0 };
  Vec3 Normal{ 0.0 };
  /// Corners of the rectangle around the plate: lower left, lower right, upper right, upper left as
  /// seen from the front with z (or, for a plate that lies flat, y) upwards.
  std::array<Vec3, 4> Corners{};
  /// Radius around Centre that holds the plate [m].
  double Radius = 0.0;
  /// Largest luminance of its cells.
  double MaximumLuminance = 0.0;
};

/// All emitters of a scene. Cells that light together (the lit cells of one sign, or one lamp cell)
/// form a cluster, and a cluster is a tree of groups that act as one point from afar.
class EmitterSet
{
public:
  EmitterSet() = default;
  /// Checks the cells; throws Error for polygons without area, negative or non-finite luminance.
  EmitterSet(std::vector<EmitterCell> cells, int bands);

  /// A group of cells of one cluster with one normal and exponent.
  struct Group
  {
    /// Flux-weighted centre, normal, and the radius around the centre that holds the group [m].
    Vec3 Centre;
    Vec3 Normal;
    double Radius;
    double Exponent;
    /// Sum of luminance times area [cd].
    Spectrum Intensity;
    /// First of two children, or -1 for a single cell.
    int FirstChild;
    /// The cell of a leaf.
    std::size_t Cell;
  };

  struct Cluster
  {
    /// Root group, and the groups' common centre, radius.
    int Root;
    Vec3 Centre;
    double Radius;
    /// Rectangle around the lit cells: its centre is Centre; half edges.
    Vec3 HalfU, HalfV;
    /// Normal of the plate where all its cells share one, else zero.
    Vec3 Normal;
  };

  const std::vector<EmitterCell>& Cells() const { return this->Cells_; }
  const Vec3& CellNormal(std::size_t cell) const { return this->Normals_[cell]; }
  double CellArea(std::size_t cell) const { return this->Areas_[cell]; }
  const Vec3& CellCentre(std::size_t cell) const { return this->Centres_[cell]; }
  const std::vector<Sign>& Signs() const { return this->Signs_; }
  const std::vector<Cluster>& Clusters() const { return this->Clusters_; }
  const std::vector<Group>& Groups() const { return this->Groups_; }
  /// Luminous flux of a cell [lm]: 2 pi L A / (n + 2).
  double CellFlux(std::size_t cell, int band) const;

private:
  int BuildGroup(std::vector<std::size_t>& cells, std::size_t begin, std::size_t end, int bands);
  void FindSigns();
  void BuildClusters(int bands);

  std::vector<EmitterCell> Cells_;
  std::vector<Vec3> Normals_, Centres_;
  std::vector<double> Areas_;
  std::vector<Sign> Signs_;
  std::vector<Cluster> Clusters_;
  std::vector<Group> Groups_;
};

} // namespace smokevis
