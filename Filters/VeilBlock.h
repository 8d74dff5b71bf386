// The smoke's share of the light of neighbouring pixels: traced where it varies, interpolated where
// it does not.
#pragma once

#include "Camera.h"
#include "View.h"

#include <vector>

namespace smokevis
{

/// A rectangle of pixels of an image. The veil is smooth over the pixels that see one plane; there
/// it is traced at some of them and interpolated between, wherever a trace in the middle confirms
/// that. Close to a sign the smoke glows in the pattern's shape: that end of the way is traced for
/// all.
class VeilBlock
{
public:
  /// The smoke before a pixel, in each band: VeilDirect, VeilMultiple, OpticalDepth.
  using Smoke = std::array<RayLight, MaxBands>;

  /// @param x,y          first pixel
  /// @param columns,rows pixels of the block
  VeilBlock(const View& view, const Camera& camera, int x, int y, int columns, int rows);

  /// Distance to what a pixel of the block sees; infinity: nothing.
  void SetDistance(int column, int row, double distance);
  /// Finds the veil of all pixels, whose distances are known by now.
  void Compute();
  const Smoke& Get(int column, int row) const
  {
    return this->Pixels_[this->Index(column, row)].Veil;
  }

private:
  struct Pixel
  {
    double Distance = 0.0;
    /// Over the depth along the camera's axis, which is linear in the picture of a plane [1/m].
    double InverseDepth = 0.0;
    bool Traced = false;
    Smoke Veil;
  };
  struct Tile
  {
    int Left, Bottom, Right, Top;
  };

  std::size_t Index(int column, int row) const
  {
    return static_cast<std::size_t>(row) * this->Columns_ + column;
  }
  Pixel& At(int column, int row) { return this->Pixels_[this->Index(column, row)]; }
  Vec3 Direction(int column, int row) const;
  void Trace(int column, int row);
  void ComputeTile(const Tile& tile);
  bool ShowsOnePlane(const Tile& tile) const;
  bool Foretells(const Pixel& first, const Pixel& second, double weight, const Pixel& truth) const;
  void Fill(const Tile& tile, int middleColumn, int middleRow);

  const View& View_;
  const Camera& Camera_;
  int X_, Y_, Columns_, Rows_, Bands_;
  std::vector<Pixel> Pixels_;
};

} // namespace smokevis
