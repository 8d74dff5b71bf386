// Holds direct light to the conservation of power where none can leave the scene.
#pragma once

#include <cstdint>
#include <optional>

namespace smokevis
{

class Scene;
struct LightField;

/// In a closed room smoke and surfaces take up what lights send out. Means over cells and patches
/// come from a few points of each and are off in smoke that differs from cell to cell like noise,
/// and at the edges of shadows: by up to 1 % of the power in all, 2 % of what comes from afar. What
/// is not known from close to the lights is scaled to make up for that.
class DirectBalance
{
public:
  /// Most that light is scaled by: what is off by more has another reason, such as a lamp that is
  /// sunk into a solid, and is left.
  static constexpr double MostChange = 0.04;

  /// @param field holds the direct light of all cells and patches; both must outlive this
  DirectBalance(const Scene& scene, LightField& field) : Scene_(scene), Field_(field) {}

  /// Whether all light meets a surface, as rays from the lights tell: an opening through which less
  /// than about a thousandth of a light leaves may be missed.
  bool Closed() const;
  /// Scales a band of the field. Returns the scale, or nothing where it is left.
  std::optional<double> Scale(int band) const;

private:
  /// Extinction coefficient times volume [m2].
  double CaptureOf(std::int64_t cell, int band) const;

  const Scene& Scene_;
  LightField& Field_;
};

} // namespace smokevis
