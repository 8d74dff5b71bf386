// Runs assimp on a file, guarded against what damaged files do to it.
#pragma once

#include "CadFormat.h"
#include "Progress.h"

#include <memory>
#include <set>
#include <string>

struct aiScene;

namespace Assimp
{
class Importer;
}

namespace smokevis
{

/// A file as assimp has read it.
class MeshImport
{
public:
  /// Throws Error where the file cannot be read.
  /// @param rewritten what to read instead of the file's content; blank to read the file
  MeshImport(const std::string& fileName, const CadFormat& format, std::string rewritten,
    Progress& progress);
  ~MeshImport();
  MeshImport(const MeshImport&) = delete;
  MeshImport& operator=(const MeshImport&) = delete;

  /// Not to be called where the progress said to stop.
  const aiScene& Scene() const { return *Scene_; }

  /// Names of files that the model refers to and that are not there.
  const std::set<std::string>& Missing() const { return Missing_; }

private:
  // The importer's file handler writes into it.
  std::set<std::string> Missing_;
  std::unique_ptr<Assimp::Importer> Importer_;
  const aiScene* Scene_ = nullptr;
};

} // namespace smokevis
