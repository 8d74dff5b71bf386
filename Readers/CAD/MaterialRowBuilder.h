// Checks the values of a material table's row.
#pragma once

#include "Errors.h"
#include "MaterialTable.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace smokevis
{

/// What messages about unknown columns and keys list.
inline constexpr const char* MaterialColumns =
  "name, reflectance, luminance, sign, sign_name and drop";

/// Checks the values of one row and puts them into it.
class MaterialRowBuilder
{
public:
  MaterialRowBuilder(const std::string& fileName, int line)
      : Where_("material table '" + fileName + "', line " + std::to_string(line))
  {
    this->Row_.Line = line;
  }

  void SetName(const std::string& name) { this->Row_.Pattern = name; }
  void SetSignName(const std::string& name) { this->Row_.Treatment.SignName = name; }
  void SetDrop(bool drop) { this->Row_.Treatment.Drop = drop; }

  void SetReflectance(const std::vector<double>& values)
  {
    this->CheckNumbers("reflectance", values, 1.0, "Give a diffuse reflectance from 0 to 1");
    this->Row_.Treatment.Reflectance = values;
  }

  void SetLuminance(const std::vector<double>& values)
  {
    this->CheckNumbers(
      "luminance", values, std::numeric_limits<float>::max(), "Give a luminance in cd/m2 from 0");
    this->Row_.Treatment.Luminance = values;
  }

  void SetSign(double value)
  {
    if (!(value >= -1.0 && value <= std::numeric_limits<int>::max()) || value != std::floor(value))
    {
      this->Refuse("sign is not a whole number from 0, or -1", "Give the sign's id, -1 for a lamp");
    }
    this->Row_.Treatment.SignId = static_cast<int>(value);
  }

  MaterialRow Finish() const
  {
    if (this->Row_.Pattern.empty())
    {
      this->Refuse("name is missing", "Give the name of a material or object, such as Glazing*");
    }
    const CadTreatment& own = this->Row_.Treatment;
    if (own.Drop.value_or(false) &&
        (own.IsEmitter() || !own.Reflectance.empty() || !own.SignName.empty()))
    {
      this->Refuse("it drops '" + this->Row_.Pattern + "' and describes its light",
        "Leave the other fields blank where drop is yes");
    }
    return this->Row_;
  }

  [[noreturn]] void Refuse(const std::string& what, const std::string& remedy) const
  {
    throw Error(this->Where_, what, remedy);
  }

private:
  void CheckNumbers(const std::string& quantity, const std::vector<double>& values, double most,
    const char* remedy) const
  {
    if (values.size() != 1 && values.size() != 3)
    {
      this->Refuse(quantity + " has " + std::to_string(values.size()) + " numbers",
        "Give one, or three for red, green and blue");
    }
    for (const double value : values)
    {
      if (!(value >= 0.0 && value <= most))
      {
        this->Refuse(quantity + " is out of range", remedy);
      }
    }
  }

  std::string Where_;
  MaterialRow Row_;
};

} // namespace smokevis
