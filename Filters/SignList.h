// The signs of a light field, as outputs list them and users choose them.
#pragma once

#include "SceneBlocks.h"

#include <map>
#include <string>
#include <vector>

namespace smokevis
{

class Scene;

/// Signs in the order in which arrays have a component for each.
struct SignList
{
  std::vector<int> Ids;
  std::vector<std::string> Names;
};

/// What emitters call the signs, by id from 0; a sign without a name is called by its id.
std::map<int, std::string> ReadSignNames(const std::vector<SurfaceBlock>& emitters);

/// A sign of which two blocks have parts that lie farther apart than either is large.
struct PartedSign
{
  std::string One, Other;
  /// Between the boxes around the parts [m].
  double Gap = 0.0;
};

/// Such signs among emitters, by id: rather two signs that were given the same.
std::map<int, PartedSign> FindPartedSigns(const std::vector<SurfaceBlock>& emitters);

/// The signs of a scene.
SignList ListSigns(const Scene& scene, const std::map<int, std::string>& names);

/// Adds the field data `SignIds` and `SignNames`.
void AddSignList(vtkDataObject& target, const SignList& signs);

} // namespace smokevis
