// Matches the rows of a material table with the materials and objects of a model.
#include "MaterialTable.h"

#include "MaterialTableText.h"

#include <fnmatch.h>

#include <algorithm>

namespace smokevis
{
namespace
{

bool Matches(const MaterialRow& row, const std::string& name)
{
  return fnmatch(row.Pattern.c_str(), name.c_str(), FNM_CASEFOLD | FNM_NOESCAPE) == 0;
}

bool Matches(const MaterialRow& row, const CadObject& object)
{
  return Matches(row, object.Name) ||
         std::any_of(object.Groups.begin(), object.Groups.end(),
           [&](const std::string& group) { return Matches(row, group); });
}

} // namespace

//------------------------------------------------------------------------------------------------
MaterialTable::MaterialTable(const std::string& fileName) : Rows_(ReadMaterialRows(fileName))
{
}

//------------------------------------------------------------------------------------------------
CadTreatment MaterialTable::Find(const CadMaterial& material, const CadObject& object) const
{
  CadTreatment result;
  for (const MaterialRow& row : this->Rows_)
  {
    if (!Matches(row, material.Name) && !Matches(row, object))
    {
      continue;
    }
    const CadTreatment& own = row.Treatment;
    result.Reflectance = own.Reflectance.empty() ? result.Reflectance : own.Reflectance;
    result.Luminance = own.Luminance.empty() ? result.Luminance : own.Luminance;
    result.SignId = own.SignId ? own.SignId : result.SignId;
    result.SignName = own.SignName.empty() ? result.SignName : own.SignName;
    result.Drop = own.Drop ? own.Drop : result.Drop;
  }
  return result;
}

//------------------------------------------------------------------------------------------------
std::vector<std::string> MaterialTable::Unmatched(const CadModel& model) const
{
  std::vector<std::string> result;
  for (const MaterialRow& row : this->Rows_)
  {
    const bool used = std::any_of(model.Materials.begin(), model.Materials.end(),
                        [&](const CadMaterial& material) { return Matches(row, material.Name); }) ||
                      std::any_of(model.Objects.begin(), model.Objects.end(),
                        [&](const CadObject& object) { return Matches(row, object); });
    if (!used)
    {
      result.push_back("line " + std::to_string(row.Line) + ", pattern '" + row.Pattern + "'");
    }
  }
  return result;
}

} // namespace smokevis
