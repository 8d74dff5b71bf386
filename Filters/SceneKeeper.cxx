// Keeps the last scene.
#include "SceneKeeper.h"

#include <utility>

namespace smokevis
{
namespace
{

bool processIsEnding = false;

struct EndOfProcess
{
  ~EndOfProcess() { processIsEnding = true; }
};

const EndOfProcess endOfProcess;

} // namespace

//------------------------------------------------------------------------------
bool ProcessIsEnding()
{
  return processIsEnding;
}

//------------------------------------------------------------------------------
SceneKeeper::~SceneKeeper()
{
  if (processIsEnding)
  {
    static_cast<void>(new std::shared_ptr<const Scene>(std::move(this->Scene_)));
  }
}

//------------------------------------------------------------------------------
bool SceneKeeper::IsLast(SceneDescription& description) const
{
  if (!this->Description_ || this->Description_->Emitters.size() != description.Emitters.size())
  {
    return false;
  }
  for (std::size_t i = 0; i < description.Emitters.size(); ++i)
  {
    const auto& last = this->Description_->Emitters[i].Table;
    auto& table = description.Emitters[i].Table;
    if (last && table && *last == *table)
    {
      table = last;
    }
  }
  return *this->Description_ == description;
}

//------------------------------------------------------------------------------
std::shared_ptr<const Scene> SceneKeeper::Make(SceneDescription description)
{
  auto copy = std::make_unique<const SceneDescription>(description);
  this->Description_.reset();
  this->Scene_ = std::make_shared<const Scene>(std::move(description), this->Scene_.get());
  this->Description_ = std::move(copy);
  return this->Scene_;
}

} // namespace smokevis
