#include "PlateStrips.h"

#include "Emitters.h"
#include "GaussNodes.h"
#include "PolygonClip.h"

#include <cmath>
#include <vector>

namespace smokevis
{

PlateStrips::PlateStrips(
  const std::array<Vec3, 4>& corners, std::span<const LightGroup> leaves, int bands)
{
  Spectrum whole{};
  for (const LightGroup& leaf : leaves)
  {
    for (int band = 0; band < bands; ++band)
    {
      whole[band] += leaf.Intensity[band];
    }
  }
  const std::array<Vec3, 2> edges = {corners[1] - corners[0], corners[3] - corners[0]};
  for (int edge = 0; edge < 2; ++edge)
  {
    const Vec3 along = edges[edge] / glm::dot(edges[edge], edges[edge]);
    const auto place = [&](const Vec3& point) { return glm::dot(point - corners[0], along); };
    for (std::size_t i = 0; i < Count; ++i)
    {
      Strip& strip = this->Strips_[edge][i];
      for (std::size_t j = 0; j < strip.Places.size(); ++j)
      {
        strip.Places[j] =
          corners[0] + (i + 0.5) / Count * edges[edge] + Nodes2[j] * edges[1 - edge];
      }
      for (const LightGroup& leaf : leaves)
      {
        const std::vector<Vec3> polygon(leaf.Corners.begin(), leaf.Corners.end());
        std::vector<Vec3> kept;
        // What the rectangle misses by rounding belongs to the strips at its ends.
        KeepBetween(polygon, place, i == 0 ? -1.0 : static_cast<double>(i) / Count,
          i + 1 == Count ? 2.0 : (i + 1.0) / Count, kept);
        const double share = kept.size() < 3 ? 0.0 : glm::length(AreaVector(kept)) / leaf.Area;
        for (int band = 0; band < bands; ++band)
        {
          strip.Share[band] += whole[band] > 0.0 ? share * leaf.Intensity[band] / whole[band] : 0.0;
        }
      }
    }
  }
}

} // namespace smokevis
