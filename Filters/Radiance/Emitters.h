// Plates of signs and lamps: what they are made of and how they group into lights.
#pragma once

#include "EmissionLaw.h"
#include "PlateStencil.h"
#include "PlateStrips.h"
#include "Types.h"

#include <memory>
#include <vector>

namespace smokevis
{

class SmokeBorders;
class SurfaceCuts;

/// One plane convex polygon of a sign's or lamp's plate. It emits from its front (right-hand side)
/// only, luminance times cos^Exponent of the angle to the normal (0: Lambertian), or as a table
/// says.
struct EmitterCell
{
  std::vector<Vec3> Vertices;
  /// Luminance along the normal; with a table, flux / (pi area) [cd/m2].
  Spectrum Luminance{};
  double Exponent = 0.0;
  /// Spread of a lamp's light over directions, instead of the exponent, and the direction of its
  /// azimuth 0 (see EmissionLaw).
  std::shared_ptr<const IntensityTable> Table;
  Vec3 TableAxis{0.0};
  /// Diffuse reflectance of both sides, 0 to 1.
  Spectrum Reflectance{};
  /// Cells of one sign share an id >= 0; -1: a lamp.
  int SignId = -1;
  /// Of a sign: 1 for the parts that are to be bright, 0 for the others, -1 where that is to be
  /// told from their brightness.
  int Part = -1;

  /// Tables are the same where they are the same object.
  bool operator==(const EmitterCell&) const = default;
};

class LightSight;

/// A sign: emitter cells with one id.
struct Sign
{
  int Id = 0;
  /// Indices of its cells.
  std::vector<std::size_t> Cells;
  Vec3 Centre{0.0};
  Vec3 Normal{0.0};
  /// Corners of the rectangle around the plate, counter-clockwise from the front, starting where
  /// its first cell starts.
  std::array<Vec3, 4> Corners{};
  /// Radius around Centre that holds the plate [m].
  double Radius = 0.0;
  /// Whether no other emitter lies so close to it that their plates might touch or overlap.
  bool Alone = false;
};

/// A part of a light: cells with one normal and law that, from afar, act as one point.
struct LightGroup
{
  /// Centre of the light that it emits, and the radius around it that holds the group [m].
  Vec3 Centre{0.0};
  double Radius = 0.0;
  Vec3 Normal{0.0};
  /// How far it reaches behind the plane through Centre [m]; 0 but for rounding where it is plane.
  double Depth = 0.0;
  EmissionLaw Law;
  /// Of the sign that it is a part of; -1: a lamp.
  int SignId = -1;
  /// Sum of luminance times area [cd]; for a leaf the luminance is this over Area.
  Spectrum Intensity{};
  double Area = 0.0;
  /// First of two children, which follow each other; -1: a leaf.
  int FirstChild = -1;
  /// A leaf's quadrilateral (a triangle repeats its last corner), else the rectangle around the
  /// group.
  std::array<Vec3, 4> Corners{};
  /// Whether something stands on the plate of the light, or goes through it: however far, it may be
  /// seen in part.
  bool Crossed = false;
  /// What stands for the leaves of a plane group with a smooth law; a leaf has none.
  std::shared_ptr<const PlateStencil> Stencil;

  /// Whether it is plane but for the rounding of single precision.
  bool Plane() const { return this->Depth <= 1e-3 * this->Radius; }
  /// Distance of a point from a leaf, or from the plane rectangle around the group [m].
  double Distance(const Vec3& point) const;
  /// Distance of a point from the edges of the leaf or of that rectangle [m].
  double EdgeDistance(const Vec3& point) const;
  /// A place between the corners, and the area for each unit of u and v there [m2].
  Vec3 At(double u, double v) const
  {
    return (1.0 - v) * ((1.0 - u) * this->Corners[0] + u * this->Corners[1]) +
           v * ((1.0 - u) * this->Corners[3] + u * this->Corners[2]);
  }
  double AreaAt(double u, double v) const
  {
    const std::array<Vec3, 4>& corners = this->Corners;
    const Vec3 du = (1.0 - v) * (corners[1] - corners[0]) + v * (corners[2] - corners[3]);
    const Vec3 dv = (1.0 - u) * (corners[3] - corners[0]) + u * (corners[2] - corners[1]);
    return glm::length(glm::cross(du, dv));
  }
};

/// All emitters of a scene. Cells that light together (the lit cells of one sign, or joined cells
/// of lamps, that share a plane and fill a good part of the rectangle around them) form one light,
/// a tree of groups, and one on each side where a border of smoke or a surface crosses them. A
/// pattern of very many cells lights its surroundings as a lattice of rectangles of the same
/// intensity does. A luminous body that is large against the scene, such as a wall, is met by
/// random lines often enough to leave it to them.
class EmitterSet
{
public:
  EmitterSet() = default;
  /// Checks the cells, and finds the signs; throws Error for polygons that are not plane and
  /// convex, and for luminances, exponents or reflectances out of range.
  EmitterSet(std::vector<EmitterCell> cells, int bands);

  /// Forms the lights.
  /// @param largestLight area above which a luminous body is left to the random lines [m2]
  /// @param borders where smoke divides the lights; null: nowhere
  /// @param cuts where surfaces do; null: nowhere
  void FormLights(
    double largestLight, const SmokeBorders* borders = nullptr, const SurfaceCuts* cuts = nullptr);
  /// Tells the lights that something stands on.
  void MarkCrossed(const LightSight& sight);

  int Bands() const { return this->Bands_; }
  const std::vector<EmitterCell>& Cells() const { return this->Cells_; }
  const Vec3& CellNormal(std::size_t cell) const { return this->Normals_[cell]; }
  const Vec3& CellCentre(std::size_t cell) const { return this->Centres_[cell]; }
  double CellArea(std::size_t cell) const { return this->Areas_[cell]; }
  const EmissionLaw& CellLaw(std::size_t cell) const { return this->Laws_[cell]; }
  /// Whether two cells of a sign lie in one plane, but for the rounding of single precision.
  bool InOnePlane(std::size_t a, std::size_t b) const;
  /// Signs in the order of their ids.
  const std::vector<Sign>& Signs() const { return this->Signs_; }
  /// Whether the cell's own light is carried by random lines, not by Lights().
  bool LeftToLines(std::size_t cell) const { return this->LeftToLines_[cell]; }
  /// Roots, among Groups(), of the lights that shine directly.
  const std::vector<int>& Lights() const { return this->Lights_; }
  const std::vector<LightGroup>& Groups() const { return this->Groups_; }
  /// The root of the light at a place among Lights().
  const LightGroup& Root(std::size_t light) const { return this->Groups_[this->Lights_[light]]; }
  /// The same light in strips.
  const PlateStrips& Strips(std::size_t light) const { return this->Strips_[light]; }
  /// Luminous flux that all cells emit [lm]; a cell's is 2 pi L A / (n + 2), or pi L A with a
  /// table.
  double Flux(int band) const;
  /// Luminous flux of one cell [lm].
  double CellFlux(std::size_t cell, int band) const;

private:
  void FindSigns();
  /// Numbers the lights (in one plane) or luminous bodies that cells belong to; cells without light
  /// of their own get -1.
  std::vector<int> JoinCells(bool samePlane) const;
  /// Adds the light that leaves of one plane, lit and dark, make.
  void AddLight(std::vector<LightGroup> leaves);
  void AddLeavesOf(std::size_t cell, std::vector<LightGroup>& leaves) const;
  /// The same of the dark cells on the board of a sign's cell.
  void AddDarkLeaves(std::size_t cell, std::vector<LightGroup>& leaves) const;
  void FillGroup(int group, std::vector<LightGroup>& leaves, std::size_t begin, std::size_t end);

  int Bands_ = 1;
  std::vector<EmitterCell> Cells_;
  std::vector<Vec3> Normals_, Centres_;
  std::vector<double> Areas_;
  std::vector<EmissionLaw> Laws_;
  std::vector<bool> LeftToLines_;
  std::vector<Sign> Signs_;
  std::vector<int> Lights_;
  std::vector<PlateStrips> Strips_;
  std::vector<LightGroup> Groups_;
};

} // namespace smokevis
