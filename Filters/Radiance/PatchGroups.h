// Surface patches that are too small to be lit one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smokevis
{

class Scene;

/// Random lines rarely meet a patch that is tiny in the scene, as those of a finely triangulated
/// CAD model are: what one line brings is then as large as it is rare, and where walls are white it
/// comes back larger with each reflection. Such patches share their indirect illuminance with those
/// that they hang together with, face the same way and reflect alike, over an area that enough
/// lines meet. Light that comes straight is known of each.
class PatchGroups
{
public:
  /// None.
  PatchGroups() = default;
  /// @param hits lines that are expected to meet each side of each patch in a sweep; of the patches
  /// of a group it becomes that of all together
  PatchGroups(const Scene& scene, int band, std::vector<float>& hits);

  /// Gives the sides of each group their mean, weighted by their exposed areas.
  /// @param illuminance [2 * patch + side]
  void Average(std::vector<float>& illuminance) const;

private:
  /// A side of a group lies in sides First_[i] to First_[i + 1] of Sides_.
  std::vector<std::size_t> First_;
  std::vector<std::uint32_t> Sides_;
  /// Exposed area of each of them over that of all [1].
  std::vector<float> Shares_;
};

} // namespace smokevis
