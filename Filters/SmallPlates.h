// Signs and lamps that are a few pixels of an image, or less than one: what they share in each
// pixel is found from areas, because samples would miss them.
#pragma once

#include "Camera.h"
#include "PixelLight.h"
#include "View.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace smokevis
{

/// The plates of an image that are small in it. The outlines of their cells are projected and cut
/// along the pixels exactly, so that the light of a plate in the picture does not depend on where
/// among the pixels it falls. Where the observer resolves less than a pixel, the light of a pixel
/// is spread evenly over a square of the size that is resolved. What of a plate is hidden is told
/// by rays to a lattice of points on it. Signs that are not plane are left out.
class SmallPlates
{
public:
  /// @param acuity smallest angle that is resolved [rad]
  SmallPlates(const View& view, const Camera& camera, double acuity);

  /// Whether a ray met the front of a small plate.
  bool Covers(const Hit& hit) const;
  /// Share of a pixel that small plates fill, 0 to 1.
  double Share(std::size_t pixel) const;
  /// Adds their light and that of the smoke before them, times their share of the pixel.
  void Add(std::size_t pixel, PixelSpectrum& light) const;
  /// Id of the small sign whose middle a pixel holds, or -1.
  int SignAt(std::size_t pixel) const;

private:
  /// A lattice point of a plate.
  struct Place
  {
    bool Visible = false;
    /// Of the front [lx], with batches of what is multiply scattered.
    Spectrum Illuminance{};
    std::array<Lanes, MaxBands> Multiple;
  };

  /// Cells that are looked at together: a sign, or a cell of a lamp.
  struct Plate
  {
    std::vector<std::size_t> Cells;
    int SignId = -1;
    /// Origin, unit vectors and extents of the rectangle around the plate [m].
    Vec3 Corner{0.0}, Across{0.0}, Up{0.0}, Normal{0.0};
    double Width = 0.0;
    double Height = 0.0;
    /// Lattice points along each side.
    int Places = 1;
  };

  /// Pixels from Left and Bottom to before Right and Top.
  struct Window
  {
    int Left = 0, Bottom = 0, Right = 0, Top = 0;

    int Columns() const { return this->Right - this->Left; }
    int Rows() const { return this->Top - this->Bottom; }
  };

  /// What a plate does to a pixel: integrals over the part of it that the plate fills.
  struct Sums
  {
    double Area = 0.0;
    /// Of the place in the picture.
    glm::dvec2 Middle{0.0};
    Spectrum Emitted{}, Reflected{};
    std::array<Lanes, MaxBands> Multiple;

    void Add(const Sums& other, double weight);
  };

  struct PlateShare
  {
    /// Point of the plate in the middle of what fills the pixel.
    Vec3 Middle{0.0};
    Sums Light;
  };

  /// Whether the sign is plane and faces the camera; the plate then.
  bool PlateOf(const Sign& sign, Plate& plate) const;
  /// The same for a cell of a lamp.
  bool PlateOf(std::size_t cell, Plate& plate) const;
  void AddPlate(const Plate& plate);
  /// Where a point is in the picture, in pixels.
  glm::dvec2 Project(const Vec3& point) const;
  /// Pixels around a plate, and the side of the square that is resolved, in pixels from 1; false
  /// where the plate is not small, not before the camera or out of the picture.
  bool Frame(const Plate& plate, Window& window, double& resolved) const;
  std::vector<Place> PlacesOn(const Plate& plate) const;
  std::vector<Sums> Draw(
    const Plate& plate, const std::vector<Place>& places, const Window& window) const;
  void DrawCell(const Plate& plate, const std::vector<Place>& places, std::size_t cell,
    const Window& window, std::vector<Sums>& pixels) const;
  void DrawPiece(const std::vector<Vec3>& piece, const Sums& look, const Window& window,
    std::vector<Sums>& pixels) const;
  /// The pixels of the window and around it after the spread over what is resolved.
  std::vector<Sums> Blurred(const std::vector<Sums>& pixels, Window& window, double resolved) const;

  const View& View_;
  const Camera& Camera_;
  double Acuity_;
  int Bands_;
  /// Of each emitter cell.
  std::vector<std::uint8_t> Small_;
  std::unordered_map<std::size_t, std::vector<PlateShare>> Shares_;
  std::unordered_map<std::size_t, int> Middles_;
};

} // namespace smokevis
