#include "FirstSource.h"

#include "CellLoops.h"
#include "LightField.h"
#include "Scene.h"

#include <cstddef>
#include <functional>

#include <glm/gtc/constants.hpp>

namespace smokevis
{

FirstSource::FirstSource(const Scene& scene, const LightField& field, int band)
    : Scene_(scene), Field_(field), Band_(band), Smoke_(scene.Smoke()),
      DirectFluence_(field.DirectFluence.data() + field.CellIndex(band, 0)),
      Scatters_(scene.Albedo() * scene.ExtinctionScale(band)),
      Emits_(4.0 * glm::pi<double>() * (1.0 - scene.Albedo()) * scene.ExtinctionScale(band))
{
}

double FirstSource::OfSmoke() const
{
  return ReduceCells(
    this->Smoke_.Cells(), 0.0,
    [this](double& sum, std::int64_t cell) { sum += this->OfCell(cell); }, std::plus<>());
}

double FirstSource::OfPatches() const
{
  const Scene& scene = this->Scene_;
  double power = 0.0;
  for (std::size_t side = 0; side < 2 * scene.Patches(); ++side)
  {
    power +=
      scene.PatchReflectance(side / 2)[this->Band_] * scene.ExposedArea(side / 2, side % 2) *
      this->Field_.DirectIlluminance[this->Field_.PatchIndex(this->Band_, side / 2, side % 2)];
  }
  const EmitterSet& lights = scene.Lights();
  for (std::size_t cell = 0; cell < lights.Cells().size(); ++cell)
  {
    power += lights.LeftToLines(cell) ? lights.CellFlux(cell, this->Band_) : 0.0;
  }
  return power;
}

double FirstSource::Whole(const Box& outer) const
{
  return this->OfSmoke() + this->OfPatches() +
         glm::pi<double>() * this->Scene_.Sky() * outer.Surface();
}

} // namespace smokevis
