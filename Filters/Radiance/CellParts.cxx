#include "CellParts.h"

#include <utility>

namespace smokevis
{

//--------------------------------------------------------------------------------------------------
CellParts::CellParts(
  std::int64_t cells, const Vec3& base, double tolerance, std::vector<CellCut> cuts)
    : Cells_(cells), Base_(base), Tolerance_(tolerance)
{
  if (cuts.empty())
  {
    return;
  }
  this->First_.assign(cells, -1);
  this->Root_.assign(cells, -1);
  this->Cut_.assign(cells, false);
  for (CellCut& cut : cuts)
  {
    const auto firstPart = static_cast<std::int32_t>(this->Parts_.size());
    const auto firstNode = static_cast<std::int32_t>(this->Nodes_.size());
    this->First_[cut.Cell] = firstPart;
    this->Root_[cut.Cell] = firstNode;
    this->Cut_[cut.Cell] = true;
    for (CellCut::Node node : cut.Nodes)
    {
      node.Front += node.Front < 0 ? -firstPart : firstNode;
      node.Behind += node.Behind < 0 ? -firstPart : firstNode;
      this->Nodes_.push_back(node);
    }
    for (CellPart& part : cut.Parts)
    {
      part.Cell = cut.Cell;
      part.Number = cut.Cell;
      const auto place = static_cast<std::int32_t>(this->Parts_.size());
      if (place > firstPart)
      {
        part.Number = cells + this->Added();
        this->Later_.push_back(place);
      }
      this->Parts_.push_back(std::move(part));
    }
  }
}

//--------------------------------------------------------------------------------------------------
std::int64_t CellParts::Locate(std::int64_t cell, const Vec3& point) const
{
  if (!this->IsCut(cell))
  {
    return cell;
  }
  std::int32_t node = this->Root_[cell];
  while (node >= 0)
  {
    const CellCut::Node& cut = this->Nodes_[node];
    node = cut.Where.Height(point - this->Base_) > 0.0 ? cut.Front : cut.Behind;
  }
  return this->Parts_[-1 - node].Number;
}

} // namespace smokevis
