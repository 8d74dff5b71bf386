// Direct fluence at any place in the smoke: from cell means where it is smooth, from the lights
// themselves where they are near.
#pragma once

#include "CellShape.h"
#include "DirectLight.h"
#include "LightField.h"
#include "NearLights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace smokevis
{

class Scene;

/// What the lights near to a cell add is taken at each place, that of all others from cell means.
class DirectField
{
public:
  /// @param field holds the direct fluence of all cells; must outlive this
  DirectField(const Scene& scene, const LightField& field);

  /// Fluence at a point of a cell of the lights that are not near to it [lx].
  double Smooth(std::int64_t cell, const Vec3& point, int band) const
  {
    const std::size_t index = band * this->Cells_ + cell;
    return this->Means_[index] > 0.0F ? this->Means_[index] * this->Shapes_[band].Value(cell, point)
                                      : 0.0;
  }
  /// Its mean over a cell, and its largest value there [lx].
  double SmoothMean(std::int64_t cell, int band) const
  {
    return this->Means_[band * this->Cells_ + cell];
  }
  double SmoothMost(std::int64_t cell, const Box& bounds, int band) const
  {
    return this->SmoothMean(cell, band) * this->Shapes_[band].Largest(cell, bounds);
  }
  /// What a piece of a ray sends out at its beginning of that fluence (CellShape::Emerging) [lx].
  double SmoothEmerging(const SmokePiece& piece, int band) const
  {
    const double mean = this->Means_[band * this->Cells_ + piece.Cell];
    return mean > 0.0 ? mean * this->Shapes_[band].Emerging(piece) : 0.0;
  }
  /// Has the processor fetch what these read.
  void Fetch(std::int64_t cell, int band) const
  {
    __builtin_prefetch(&this->Means_[band * this->Cells_ + cell]);
    this->Shapes_[band].Fetch(cell);
  }
  /// Whether the direct fluence varies inside a cell by more than a flat source may.
  bool Varies(std::int64_t cell, int band) const
  {
    return !this->Variation_.empty() &&
           this->Variation_[band * this->Cells_ + cell] != Variation::Flat;
  }
  /// Calls visit(length, fluence) for the parts that a piece of a ray is cut into inside a cell
  /// where the direct fluence varies, with an estimate of the mean direct fluence of each [lx].
  /// @param depth of the piece in the band
  /// @param place which of the near lights' fluence is taken in each part and where, 0 to 1; the
  /// mean over uniform places is that of all
  template <class Visit>
  void ForEachPart(std::int64_t cell, const Vec3& origin, const Vec3& direction, double begin,
    double end, double depth, double place, int band, Visit&& visit) const
  {
    const int parts = Parts(depth);
    for (int part = 0; part < parts; ++part)
    {
      const double from = begin + (end - begin) * part / parts;
      const double to = begin + (end - begin) * (part + 1) / parts;
      double fluence = this->Smooth(cell, origin + 0.5 * (from + to) * direction, band);
      if (this->Near(cell))
      {
        fluence += this->NearFluence(cell, origin, direction, from, to, place, band);
      }
      visit(to - from, fluence);
    }
  }
  bool Near(std::int64_t cell) const { return this->Lights_ && this->Lights_->Place(cell) >= 0; }
  /// Fluence of the lights near to a cell where it varies, at one place of a piece of a ray inside
  /// it, so weighted that its mean over uniform places is that along the piece [lx].
  /// @param place 0 to 1
  double NearFluence(std::int64_t cell, const Vec3& origin, const Vec3& direction, double begin,
    double end, double place, int band) const;
  /// Light of the near lights that such a piece scatters towards its beginning, before what lies
  /// ahead of the piece dims it [cd/m2].
  /// @param extinction of the cell in the band [1/m]
  double NearVeil(std::int64_t cell, const Vec3& origin, const Vec3& direction, double begin,
    double end, double extinction, int band) const;

private:
  /// Optical depth of the parts that thick pieces are cut into, and most parts of one.
  static constexpr double PartDepth = 0.5;
  static constexpr int MostParts = 8;

  /// Takes the near lights from the means of the cells that they are near to.
  void FindOthers();
  void FindVarying();
  /// Parts that a piece of a ray is cut into: the source is flat in each.
  static int Parts(double depth)
  {
    return depth > PartDepth
             ? static_cast<int>(std::min<double>(MostParts, std::ceil(depth / PartDepth)))
             : 1;
  }

  const Scene& Scene_;
  const LightField& Field_;
  DirectLight Direct_;
  std::size_t Cells_;
  /// Fluence of the lights that are not near [lx]: [band][cell].
  std::vector<float> Means_;
  std::vector<CellShape> Shapes_;
  /// None where no smoke scatters.
  const NearLights* Lights_ = nullptr;
  /// Why the fluence varies inside a cell by more than a flat source may: a light is close to the
  /// cell, or its smoke is thick. [band][cell]
  enum class Variation : std::uint8_t
  {
    Flat,
    Close,
    Thick
  };
  std::vector<Variation> Variation_;
};

} // namespace smokevis
