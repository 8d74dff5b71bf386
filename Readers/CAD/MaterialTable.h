// The analyst's word on materials and objects: what to leave out, what reflects and what shines.
#pragma once

#include "CadModel.h"

#include <optional>
#include <string>
#include <vector>

namespace smokevis
{

/// What to do with the triangles of one material and object. What is not given stays as the file
/// has it.
struct CadTreatment
{
  /// Diffuse reflectance, 0 to 1, one number or red, green and blue; blank: not given.
  std::vector<double> Reflectance;
  /// Luminance of the front [cd/m2], one number or red, green and blue; blank: not given.
  std::vector<double> Luminance;
  /// Id of the sign from 0, or -1 for a lamp.
  std::optional<int> SignId;
  std::string SignName;
  std::optional<bool> Drop;

  /// Whether the triangles belong to the emitters.
  bool IsEmitter() const { return !this->Luminance.empty() || this->SignId.has_value(); }
};

/// A row of the table.
struct MaterialRow
{
  /// With * for any text, ? for one character and [abc] for one of several; case does not matter.
  std::string Pattern;
  CadTreatment Treatment;
  /// Line of the file.
  int Line = 0;
};

/// Rows, of which later ones override what earlier ones say.
class MaterialTable
{
public:
  MaterialTable() = default;

  /// Reads a table, JSON where the file's extension is .json, else CSV. Throws Error that names
  /// file and line.
  explicit MaterialTable(const std::string& fileName);

  /// All that the rows say whose pattern matches the material's name, the object's name or that of
  /// one of the object's groups.
  CadTreatment Find(const CadMaterial& material, const CadObject& object) const;

  /// The rows whose pattern matches nothing in a model, each as "line 3, pattern 'Glass*'".
  std::vector<std::string> Unmatched(const CadModel& model) const;

private:
  std::vector<MaterialRow> Rows_;
};

} // namespace smokevis
