// Lists signs.
#include "SignList.h"

#include "Box.h"
#include "LightFieldInput.h"
#include "Scene.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace smokevis
{
namespace
{

std::string NameOf(int id)
{
  return "Sign " + std::to_string(id);
}

/// Calls visit(id, cell) for the cells of a block's signs.
template <class Visit> void ForEachSignCell(const SurfaceBlock& block, Visit&& visit)
{
  vtkDataArray* const ids = block.Mesh->GetCellData()->GetArray("SignId");
  for (vtkIdType cell = 0; ids && cell < ids->GetNumberOfTuples(); ++cell)
  {
    if (const int id = static_cast<int>(ids->GetComponent(cell, 0)); id >= 0)
    {
      visit(id, cell);
    }
  }
}

/// The boxes around a block's signs, by id.
std::map<int, Box> SignBounds(const SurfaceBlock& block)
{
  std::map<int, Box> bounds;
  ForEachSignCell(block,
    [&](int id, vtkIdType cell)
    {
      double own[6];
      block.Mesh->GetCellBounds(cell, own);
      bounds.try_emplace(id, Box::Nothing())
        .first->second.Add({{own[0], own[2], own[4]}, {own[1], own[3], own[5]}});
    });
  return bounds;
}

/// Distance between two boxes [m].
double GapBetween(const Box& a, const Box& b)
{
  return glm::length(glm::max(Vec3(0.0), glm::max(a.Lower - b.Upper, b.Lower - a.Upper)));
}

} // namespace

//------------------------------------------------------------------------------
std::map<int, std::string> ReadSignNames(const std::vector<SurfaceBlock>& emitters)
{
  std::map<int, std::string> names;
  for (const SurfaceBlock& block : emitters)
  {
    auto* const texts =
      vtkStringArray::SafeDownCast(block.Mesh->GetCellData()->GetAbstractArray("SignName"));
    ForEachSignCell(block,
      [&](int id, vtkIdType cell)
      {
        const std::string name = texts ? std::string(texts->GetValue(cell)) : std::string();
        names.emplace(id, name.empty() ? NameOf(id) : name);
      });
  }
  return names;
}

//------------------------------------------------------------------------------
std::map<int, PartedSign> FindPartedSigns(const std::vector<SurfaceBlock>& emitters)
{
  // The first block that has a sign, and where.
  std::map<int, std::pair<const SurfaceBlock*, Box>> firsts;
  std::map<int, PartedSign> parted;
  for (const SurfaceBlock& block : emitters)
  {
    for (const auto& [id, bounds] : SignBounds(block))
    {
      const auto& [first, others] = firsts.try_emplace(id, &block, bounds).first->second;
      const double gap = GapBetween(others, bounds);
      if (gap > std::max(glm::length(others.Size()), glm::length(bounds.Size())))
      {
        parted.try_emplace(id, PartedSign{first->Name, block.Name, gap});
      }
    }
  }
  return parted;
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
