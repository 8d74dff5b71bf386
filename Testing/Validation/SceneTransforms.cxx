// Scenes of the library scaled, moved and turned.
#include "SceneLibrary.h"

#include <glm/gtc/matrix_transform.hpp>

namespace smokevis::scenes
{

//--------------------------------------------------------------------------------------------------
SceneDescription Scaled(SceneDescription description, double factor)
{
  for (SmokeGrid& grid : description.Grids)
  {
    for (std::vector<double>& nodes : grid.Nodes)
    {
      std::for_each(nodes.begin(), nodes.end(), [&](double& node) { node *= factor; });
    }
    for (float& extinction : grid.Extinction)
    {
      extinction = static_cast<float>(extinction / factor);
    }
  }
  for (Vec3& point : description.Surfaces.Points)
  {
    point *= factor;
  }
  for (EmitterCell& cell : description.Emitters)
  {
    std::for_each(
      cell.Vertices.begin(), cell.Vertices.end(), [&](Vec3& vertex) { vertex *= factor; });
  }
  return description;
}

//--------------------------------------------------------------------------------------------------
SceneDescription Moved(SceneDescription description, const Vec3& offset)
{
  for (SmokeGrid& grid : description.Grids)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::for_each(grid.Nodes[axis].begin(), grid.Nodes[axis].end(),
        [&](double& node) { node += offset[axis]; });
    }
  }
  for (Vec3& point : description.Surfaces.Points)
  {
    point += offset;
  }
  for (EmitterCell& cell : description.Emitters)
  {
    std::for_each(
      cell.Vertices.begin(), cell.Vertices.end(), [&](Vec3& vertex) { vertex += offset; });
  }
  return description;
}

//--------------------------------------------------------------------------------------------------
SceneDescription Turned(SceneDescription description, const glm::dmat3& turn)
{
  for (Vec3& point : description.Surfaces.Points)
  {
    point = turn * point;
  }
  for (EmitterCell& cell : description.Emitters)
  {
    for (Vec3& vertex : cell.Vertices)
    {
      vertex = turn * vertex;
    }
  }
  return description;
}

//--------------------------------------------------------------------------------------------------
glm::dmat3 Rotation(double degrees, const Vec3& axis)
{
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(axis)));
}

} // namespace smokevis::scenes
