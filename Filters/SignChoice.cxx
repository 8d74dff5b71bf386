// Finds the sign that a user means.
#include "SignChoice.h"

#include "Errors.h"
#include "View.h"

#include <algorithm>

namespace smokevis
{
namespace
{

std::map<int, std::string> NamesIn(vtkDataObject* lightField)
{
  return ReadSignNames(CollectSurfaces(FindBlock(lightField, "Emitters"), "Emitters"));
}

std::string Entry(int id, const std::string& name)
{
  return std::to_string(id) + ": " + name;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<std::string> SignChoices(vtkDataObject* lightField)
{
  std::vector<std::string> entries = {SignById};
  for (const auto& [id, name] : NamesIn(lightField))
  {
    entries.push_back(Entry(id, name));
  }
  return entries;
}

//------------------------------------------------------------------------------
int ChooseSign(const std::string& wanted, int byId, vtkDataObject* lightField)
{
  if (wanted.empty() || wanted == SignById)
  {
    return byId;
  }
  std::string known;
  for (const auto& [id, name] : NamesIn(lightField))
  {
    if (wanted == Entry(id, name) || wanted == name)
    {
      return id;
    }
    known += (known.empty() ? "'" : ", '") + Entry(id, name) + "'";
  }
  throw Error("TargetSignName", "there is no sign '" + wanted + "'",
    "The signs of this light field: " + (known.empty() ? "none" : known));
}

//------------------------------------------------------------------------------
std::size_t FindSign(const View& view, int id)
{
  const auto& signs = view.TheScene().Lights().Signs();
  const auto found =
    std::find_if(signs.begin(), signs.end(), [id](const Sign& sign) { return sign.Id == id; });
  return found == signs.end() ? NoSign : static_cast<std::size_t>(found - signs.begin());
}

//------------------------------------------------------------------------------
int LargestSign(const std::vector<int>& signIds)
{
  std::map<int, std::size_t> pixels;
  for (const int id : signIds)
  {
    if (id >= 0)
    {
      ++pixels[id];
    }
  }
  int largest = -1;
  std::size_t most = 0;
  for (const auto& [id, count] : pixels)
  {
    if (count > most)
    {
      most = count;
      largest = id;
    }
  }
  return largest;
}

} // namespace smokevis
