// Runs assimp on a file, guarded against what damaged files do to it.
#include "MeshImport.h"

#include "CrashGuard.h"
#include "Errors.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/ProgressHandler.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

namespace smokevis
{
namespace
{

class ImportProgress : public Assimp::ProgressHandler
{
public:
  explicit ImportProgress(Progress& progress) : Progress_(progress) {}
  bool Update(float fraction) override
  {
    this->Farthest_ = std::max(this->Farthest_, std::clamp(fraction, 0.0F, 1.0F));
    this->Progress_.Report(this->Farthest_);
    return !this->Progress_.ShouldStop();
  }

private:
  Progress& Progress_;
  float Farthest_ = 0.0F;
};

/// Opens a model and the files that it refers to, and notes those that are not there.
class ImportFiles : public Assimp::DefaultIOSystem
{
public:
  /// @param rewritten content of the model's own file, where it is another than on disk
  ImportFiles(const std::string& model, std::string rewritten, std::set<std::string>& missing)
      : ModelFile_(model), Rewritten_(std::move(rewritten)), Missing_(missing)
  {
  }
  bool Exists(const char* file) const override
  {
    // A pipe would be waited for.
    std::error_code problem;
    return std::filesystem::is_regular_file(file, problem);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override
  {
    if (!this->Rewritten_.empty() && this->ModelFile_ == file)
    {
      return new Assimp::MemoryIOStream(
        reinterpret_cast<const std::uint8_t*>(this->Rewritten_.data()), this->Rewritten_.size());
    }
    Assimp::IOStream* const stream =
      this->Exists(file) ? Assimp::DefaultIOSystem::Open(file, mode) : nullptr;
    if (!stream)
    {
      this->Missing_.insert(std::filesystem::path(file).filename().string());
    }
    return stream;
  }

private:
  std::string ModelFile_;
  std::string Rewritten_;
  std::set<std::string>& Missing_;
};

} // namespace

//------------------------------------------------------------------------------------------------
MeshImport::MeshImport(
  const std::string& fileName, const CadFormat& format, std::string rewritten, Progress& progress)
    : Importer_(std::make_unique<Assimp::Importer>())
{
  Importer_->SetIOHandler(new ImportFiles(fileName, std::move(rewritten), Missing_));
  Importer_->SetProgressHandler(new ImportProgress(progress));
  Importer_->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  Importer_->SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  Importer_->SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  const std::string failure = CrashGuard().Run(
    [&]()
    {
      Scene_ =
        Importer_->ReadFile(fileName, aiProcess_ValidateDataStructure | aiProcess_Triangulate);
    });
  if (Missing_.size() > 1)
  {
    // In place of an OBJ's material file assimp looks for one named after the model.
    Missing_.erase(std::filesystem::path(fileName).stem().string() + ".mtl");
  }
  std::string why = failure.empty() ? Importer_->GetErrorString() : failure;
  if (!failure.empty())
  {
    // It was left in the middle of its work: deleting it would follow the same pointers again.
    static_cast<void>(Importer_.release());
    Scene_ = nullptr;
  }
  if (!progress.ShouldStop() && (!Scene_ || !Scene_->mRootNode))
  {
    why.erase(why.find_last_not_of(". \n") + 1);
    throw Error(fileName,
      "it cannot be read as " + std::string(format.Name) + (why.empty() ? "" : " (" + why + ")"),
      "Check that the file is complete, or export it again");
  }
}

//------------------------------------------------------------------------------------------------
MeshImport::~MeshImport() = default;

} // namespace smokevis
