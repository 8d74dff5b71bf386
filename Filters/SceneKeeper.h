// Makes scenes, and keeps of one what the next can use: time steps and new views change little.
#pragma once

#include "Scene.h"

#include <memory>

namespace smokevis
{

/// Holds the scene that it made last.
class SceneKeeper
{
public:
  SceneKeeper() = default;
  /// Where the process is already ending the scene is left to the system: Embree, which it needs to
  /// take itself apart, may be gone by the time that ParaView deletes its last filters.
  ~SceneKeeper();
  SceneKeeper(const SceneKeeper&) = delete;
  SceneKeeper& operator=(const SceneKeeper&) = delete;

  /// Whether a description is that of the last scene, value by value. Intensity tables of the same
  /// content are replaced by the last scene's.
  bool IsLast(SceneDescription& description) const;

  /// The scene of a description. Search structures are taken over from the last scene where the
  /// shapes are the same.
  std::shared_ptr<const Scene> Make(SceneDescription description);

private:
  /// Empty before the first scene.
  std::unique_ptr<const SceneDescription> Description_;
  std::shared_ptr<const Scene> Scene_;
};

/// Whether the static objects of this library are being destroyed, which is before Embree's are.
bool ProcessIsEnding();

} // namespace smokevis
