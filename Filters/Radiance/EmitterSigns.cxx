// EmitterSet's part for signs: which cells make one up, and where it lies.
#include "Emitters.h"

#include "Box.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace smokevis
{

namespace
{

/// The first edge of a polygon that is no mere rounding.
Vec3 FirstEdge(const std::vector<Vec3>& vertices)
{
  constexpr double LeastShare = 1e-3;
  std::vector<Vec3> edges;
  double longest = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    edges.push_back(vertices[(i + 1) % vertices.size()] - vertices[i]);
    longest = std::max(longest, glm::length(edges.back()));
  }
  return *std::find_if(edges.begin(), edges.end(),
    [&](const Vec3& edge) { return glm::length(edge) >= LeastShare * longest; });
}

} // namespace

void EmitterSet::FindSigns()
{
  std::map<int, Sign> signs;
  for (std::size_t i = 0; i < this->Cells_.size(); ++i)
  {
    if (this->Cells_[i].SignId >= 0)
    {
      signs[this->Cells_[i].SignId].Cells.push_back(i);
    }
  }
  for (auto& [id, sign] : signs)
  {
    sign.Id = id;
    double faces = 0.0;
    for (const std::size_t cell : sign.Cells)
    {
      sign.Normal += this->Areas_[cell] * this->Normals_[cell];
      faces += this->Areas_[cell];
    }
    // Cells that face all ways have no common front but what rounding leaves: the first one's
    // stands for them.
    constexpr double Rounding = 1e-6;
    const Vec3 first = this->Normals_[sign.Cells.front()];
    sign.Normal = glm::length(sign.Normal) > Rounding * faces ? glm::normalize(sign.Normal) : first;
    const std::vector<Vec3>& vertices = this->Cells_[sign.Cells.front()].Vertices;
    const Vec3 edge = FirstEdge(vertices);
    const Vec3 u = glm::normalize(edge - glm::dot(edge, sign.Normal) * sign.Normal);
    const Vec3 v = glm::cross(sign.Normal, u);
    glm::dvec2 low(1e300);
    glm::dvec2 high(-1e300);
    double depth = 0.0;
    for (const std::size_t cell : sign.Cells)
    {
      for (const Vec3& vertex : this->Cells_[cell].Vertices)
      {
        const glm::dvec2 at(glm::dot(vertex - vertices[0], u), glm::dot(vertex - vertices[0], v));
        low = glm::min(low, at);
        high = glm::max(high, at);
      }
      depth += this->Areas_[cell] * glm::dot(this->Centres_[cell] - vertices[0], sign.Normal);
    }
    const Vec3 base = vertices[0] + depth / faces * sign.Normal;
    sign.Corners = {base + low.x * u + low.y * v, base + high.x * u + low.y * v,
      base + high.x * u + high.y * v, base + low.x * u + high.y * v};
    sign.Centre = 0.5 * (sign.Corners[0] + sign.Corners[2]);
    sign.Radius = 0.5 * glm::length(sign.Corners[2] - sign.Corners[0]);
    this->Signs_.push_back(sign);
  }
  std::vector<Box> bounds;
  std::transform(this->Cells_.begin(), this->Cells_.end(), std::back_inserter(bounds),
    [](const EmitterCell& cell) { return Box::Around(cell.Vertices); });
  for (Sign& sign : this->Signs_)
  {
    Box around = Box::Around(sign.Corners);
    around.Lower -= sign.Radius;
    around.Upper += sign.Radius;
    sign.Alone = true;
    for (std::size_t cell = 0; cell < bounds.size() && sign.Alone; ++cell)
    {
      sign.Alone = this->Cells_[cell].SignId == sign.Id || !bounds[cell].Meets(around);
    }
  }
}

} // namespace smokevis
