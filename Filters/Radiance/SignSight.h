// What an eye sees of a sign: its plane parts, in blocks that each show whole or in part.
#pragma once

#include "PlateColumns.h"
#include "PlateEdges.h"
#include "PlatePattern.h"
#include "SignFacets.h"
#include "SignVeil.h"

#include <vector>

namespace smokevis
{

/// Blocks of a sign's plate along its longer side, at least, and where smoke before it is uneven.
inline constexpr double UsualBlocks = 8.0;
inline constexpr double ManyBlocks = 16.0;

/// What is seen of a sign through clear air. Blocks follow the pattern's columns and rows. Where
/// something hides a part of the sign, they are halved along its edges (PlateEdges.h).
class SignSight
{
public:
  /// Blocks that light arrives from alike, of which something is seen.
  struct Zone
  {
    /// Among Places().
    std::size_t Place = 0;
    /// An emitter cell that it shows.
    std::size_t Cell = 0;
    /// Whether any cell in it reflects.
    bool Reflects = false;
    /// Column and row among all zones of its part.
    std::array<std::size_t, 2> At{};
  };
  /// A plane part of the sign.
  struct Part
  {
    Facet Front;
    PlatePattern Pattern;
    /// Solid angle of a unit of the pattern's area in each block, of what is not hidden.
    std::vector<double> Densities;
    /// The zone of each block; of blocks of which nothing is seen, any.
    std::vector<std::size_t> ZoneOf;
    std::vector<Zone> Zones;
  };

  /// @param blocks along the plate's longer side, at least
  SignSight(const View& view, const Sign& sign, const Vec3& eye, double acuity, double blocks);

  const std::vector<Part>& Parts() const { return this->Parts_; }
  /// Whether the eye makes out all detail: no pixels average what a zone shows.
  bool Resolved() const { return this->Pixels_[0] == 0; }
  /// Of all zones of all parts.
  const std::vector<SeenPlace>& Places() const { return this->Places_; }
  /// Columns and rows of the pattern.
  const PlateColumns& Across() const { return this->Across_; }
  const PlateColumns& Up() const { return this->Up_; }
  /// Solid angle of what is seen, and its share of what faces the eye.
  double Seen() const { return this->Seen_; }
  double VisibleFraction() const { return this->Seen_ / this->All_; }
  /// Whether something hides a part of what faces the eye.
  bool PartlyHidden() const { return this->Seen_ < (1.0 - 1e-9) * this->All_; }
  /// Whether nothing reaches between the eye and what faces it, so that no part is looked at.
  bool Clear() const { return this->Clear_; }

private:
  PlateBorders Borders(double blocks) const;
  /// Adds borders along an edge (0: across, 1: up) where planes of cell faces through the eye meet
  /// the plate along the other edge: smoke may differ on both sides of them along the whole way.
  std::vector<double> CutByFaces(std::vector<double> borders, int axis) const;
  /// Borders along an edge, and more where the smoke before the plate dims it
  /// more at one border than at the next.
  std::vector<double> CutBySmoke(const std::vector<double>& borders, int axis) const;
  std::array<int, 2> Pixels(double acuity) const;
  PlatePattern PatternOf(
    const Facet& facet, const PatternAxis& across, const PatternAxis& up) const;
  /// Takes in facets in whole blocks, a zone each.
  /// @param clear whether nothing lies before each, so that it need not be looked at
  void AddWhole(
    const std::vector<Facet>& facets, const std::vector<bool>& clear, const PlateBorders& borders);
  /// Takes them in where something hides a part; blocks that were one stay one zone.
  void AddCut(const std::vector<Facet>& facets, const std::vector<PlateLook>& looks,
    const std::vector<std::vector<glm::dvec2>>& odd, const PlateBorders& borders);
  /// @param blocks their borders
  /// @param shares of them that are seen
  /// @param zoneOf each of them, from 0 on, row after row
  /// @param borders of the zones
  void AddPart(const Facet& facet, PlatePattern pattern, const PlateBorders& blocks,
    const std::vector<double>& shares, const std::vector<std::size_t>& zoneOf,
    const PlateBorders& borders);
  /// Share of a block's places that the eye sees.
  double VisibleShare(const Facet& facet, const PatternBlock& block) const;
  double DensityOf(const Facet& facet, const Vec3& point) const;
  /// Solid angle of a rectangle of the plate over what the density in its middle tells, which is
  /// too much close to the eye.
  double NearShare(const Facet& facet, const glm::dvec2& low, const glm::dvec2& high) const;
  Vec3 PointOf(const Facet& facet, const glm::dvec2& place) const;

  const View& View_;
  const EmitterSet& Lights_;
  const Sign& Plate_;
  const Vec3& Eye_;
  PlateColumns Across_, Up_;
  Vec3 EdgeU_, EdgeV_;
  /// Of the observer's image along both edges; none where all detail is resolved.
  std::array<int, 2> Pixels_;
  /// Whether there are many blocks, since smoke is uneven.
  bool Fine_;
  std::vector<bool> Lit_;
  bool Clear_ = false;
  std::vector<Part> Parts_;
  std::vector<SeenPlace> Places_;
  /// Solid angle of all that faces the eye, and of what it sees of that.
  double All_ = 0.0;
  double Seen_ = 0.0;
};

} // namespace smokevis
