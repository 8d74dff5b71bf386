#include "FolderNames.h"

#include <algorithm>

namespace smokevis
{

namespace
{

std::string SmallLetters(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

} // namespace

//------------------------------------------------------------------------------------------------
std::optional<std::filesystem::path> FolderNames::Find(
  const std::filesystem::path& folder, const std::filesystem::path& relative) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::filesystem::path found = folder;
  for (const std::filesystem::path& part : relative)
  {
    std::error_code problem;
    if (std::filesystem::exists(found / part, problem))
    {
      found /= part;
      continue;
    }
    const Names& names = this->List(found);
    const auto alike = names.find(SmallLetters(part.string()));
    if (alike == names.end() || alike->second.size() != 1)
    {
      return std::nullopt;
    }
    found /= alike->second.front();
  }
  return found;
}

//------------------------------------------------------------------------------------------------
const FolderNames::Names& FolderNames::List(const std::filesystem::path& folder) const
{
  const auto [place, isNew] = folders_.try_emplace(folder);
  if (isNew)
  {
    std::error_code problem;
    const std::filesystem::path listed = folder.empty() ? "." : folder;
    for (std::filesystem::directory_iterator entry(listed, problem), end; !problem && entry != end;
         entry.increment(problem))
    {
      const std::string name = entry->path().filename().string();
      place->second[SmallLetters(name)].push_back(name);
    }
  }
  return place->second;
}

} // namespace smokevis
