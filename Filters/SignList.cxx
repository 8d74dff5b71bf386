// Lists signs.
#include "SignList.h"

#include "LightFieldInput.h"
#include "Scene.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

namespace smokevis
{
namespace
{

std::string NameOf(int id)
{
  return "Sign " + std::to_string(id);
}

} // namespace

//------------------------------------------------------------------------------
std::map<int, std::string> ReadSignNames(const std::vector<SurfaceBlock>& emitters)
{
  std::map<int, std::string> names;
  for (const SurfaceBlock& block : emitters)
  {
    vtkCellData* const cells = block.Mesh->GetCellData();
    vtkDataArray* const ids = cells->GetArray("SignId");
    auto* const texts = vtkStringArray::SafeDownCast(cells->GetAbstractArray("SignName"));
    for (vtkIdType i = 0; ids && i < ids->GetNumberOfTuples(); ++i)
    {
      const int id = static_cast<int>(ids->GetComponent(i, 0));
      if (id >= 0)
      {
        const std::string name = texts ? std::string(texts->GetValue(i)) : std::string();
        names.emplace(id, name.empty() ? NameOf(id) : name);
      }
    }
  }
  return names;
}

//------------------------------------------------------------------------------
SignList ListSigns(const Scene& scene, const std::map<int, std::string>& names)
{
  SignList list;
  for (const Sign& sign : scene.Lights().Signs())
  {
    const auto found = names.find(sign.Id);
    list.Ids.push_back(sign.Id);
    list.Names.push_back(found == names.end() ? NameOf(sign.Id) : found->second);
  }
  return list;
}

//------------------------------------------------------------------------------
void AddSignList(vtkDataObject& target, const SignList& signs)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName("SignIds");
  for (const int id : signs.Ids)
  {
    ids->InsertNextValue(id);
  }
  target.GetFieldData()->AddArray(ids);
  AddFieldTexts(target, "SignNames", signs.Names);
}

} // namespace smokevis
