// What surfaces have to do with the diffusion of light beside them.
#pragma once

#include "Types.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace smokevis
{

class Scene;

/// Net flux over a difference of fluence across some optical depth, by Fick's law, is 1 over this.
/// Light that is even inside a thick block comes to a face from its own side alone, which is a
/// quarter of the fluence: that bounds the resistance, or else too much would be completed.
/// @param atFaces resistance of Marshak's conditions at the ends of the depth
double DiffusionResistance(double depth, double atFaces);

/// Irradiance of a surface over the fluence at some optical depth before it: by Marshak's condition
/// it is half the fluence there and the net flux.
double IncidentShare(double reflectance, double depth);

/// The sides of patches, in parts that bound one block of diffusion each.
class DiffusionSides
{
public:
  /// @param block where a point before a side lies, or -1 where in none
  /// @param depth optical depth from the middle of a block to where a normal leads out of it
  /// @param blocks how many there are
  /// @param edge length that parts of patches need not be smaller than [m]
  DiffusionSides(const Scene& scene, int band,
    const std::function<std::int32_t(std::size_t, const Vec3&)>& block,
    const std::function<double(std::int32_t, const Vec3&)>& depth, std::size_t blocks, double edge);

  /// Adds what a sweep would change of a side's illuminance [lx] to its own residual, which comes
  /// after those of the blocks, and to those of its blocks [lm]: the surface sends that on.
  void AddResidual(std::size_t side, double change, std::vector<double>& residual) const
  {
    residual[this->Absorbed_.size() + side] += change;
    for (std::size_t i = this->First_[side]; i < this->First_[side + 1]; ++i)
    {
      residual[this->Parts_[i].Block] += this->Parts_[i].Sends * change;
    }
  }
  /// Mean illuminance of a side where blocks have some fluence [lx].
  template <class Values> double Illuminance(std::size_t side, const Values& fluence) const
  {
    double sum = 0.0;
    for (std::size_t i = this->First_[side]; i < this->First_[side + 1]; ++i)
    {
      sum += this->Parts_[i].Share * fluence[this->Parts_[i].Block];
    }
    return sum;
  }
  /// Illuminance that the light which a side sent on itself adds to that of its blocks' fluence,
  /// over what that was: less than nothing, since not all of their fluence comes towards it.
  float Own(std::size_t side) const { return this->Own_[side]; }
  std::size_t Count() const { return this->First_.size() - 1; }
  /// What surfaces absorb over the fluence of a block [m2]; also of those that stand inside of it.
  double Absorbed(std::size_t block) const { return this->Absorbed_[block]; }

private:
  struct Part
  {
    std::int32_t Block;
    /// Illuminance of the whole side that it adds over the block's fluence, and power that the
    /// block gains over that illuminance [m2].
    float Share, Sends;
  };
  std::vector<Part> Parts_;
  /// First part of each side, and the end.
  std::vector<std::size_t> First_;
  /// Of each block.
  std::vector<double> Absorbed_;
  /// Of each side.
  std::vector<float> Own_;
};

} // namespace smokevis
