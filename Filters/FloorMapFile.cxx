// Lays floor maps out in files.
#include "FloorMapFile.h"

#include "Errors.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <locale>

namespace smokevis
{
namespace
{

/// What is written of a map where the map has it.
struct Quantity
{
  const char* Array;
  const char* Name;
  NetcdfFile::Type Type;
  const char* Unit;
  const char* LongName;
  bool EachSign;
};

constexpr NetcdfFile::Type Float = NetcdfFile::Type::Float;
constexpr NetcdfFile::Type Integer = NetcdfFile::Type::Integer;

const std::vector<Quantity>& Quantities()
{
  static const std::vector<Quantity> quantities = {
    {"PerceivedContrast", "perceived_contrast", Float, "1",
      "standard deviation of the sign's luminance over its mean and the eye's own noise", true},
    {"Contrast", "contrast", Float, "1", "standard deviation over mean of the sign's luminance",
      true},
    {"SignLuminance", "sign_luminance", Float, "cd m-2",
      "luminance of the lit parts of the sign as it arrives", true},
    {"VisibleFraction", "visible_fraction", Float, "1", "share of the sign's plate that shows",
      true},
    {"Visibility", "visibility", Float, "1", "largest perceived contrast of all signs", false},
    {"VisibilityError", "visibility_error", Float, "1",
      "standard error of visibility by the light field's noise", false},
    {"VisibilityDivisionError", "visibility_division_error", Float, "1",
      "standard error of visibility by uneven smoke between the places looked at", false},
    {"VisibleProbability", "visible_probability", Float, "1",
      "share of observers who see the best sign", false},
    {"BestSign", "best_sign", Integer, "1", "id of the best sign, -1: none in view", false},
    {"Status", "status", Integer, "1", "whether a sign is seen", false}};
  return quantities;
}

std::vector<int> SignIds(vtkImageData* map)
{
  vtkDataArray* const array = map->GetFieldData()->GetArray("SignIds");
  vtkDataArray* const contrast = map->GetPointData()->GetArray("PerceivedContrast");
  if (!array || !contrast || array->GetNumberOfValues() != contrast->GetNumberOfComponents())
  {
    throw Error("floor map", "it has no PerceivedContrast with a component for each of its SignIds",
      "Give the output of FloorMapOfVisibility, or files that it was saved to");
  }
  std::vector<int> ids;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    ids.push_back(static_cast<int>(array->GetComponent(i, 0)));
  }
  return ids;
}

std::vector<std::string> SignNames(vtkImageData* map, const std::vector<int>& ids)
{
  auto* const array =
    vtkStringArray::SafeDownCast(map->GetFieldData()->GetAbstractArray("SignNames"));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    names.push_back(array && static_cast<vtkIdType>(i) < array->GetNumberOfValues()
                      ? array->GetValue(static_cast<vtkIdType>(i))
                      : "Sign " + std::to_string(ids[i]));
  }
  return names;
}

/// The array of a map that must be as in the first one.
vtkDataArray* SameArray(vtkImageData* map, const std::string& name, double time, int components)
{
  vtkDataArray* const array = map->GetPointData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfComponents() != components)
  {
    throw Error("floor map at " + std::to_string(time) + " s",
      "its array " + name + " is not like that of the first map",
      "Give maps with the same signs at all times");
  }
  return array;
}

} // namespace

//------------------------------------------------------------------------------
FloorMapNetcdf::FloorMapNetcdf(const std::string& path, vtkImageData* map)
    : File_(path), SignIds_(SignIds(map)), SignNames_(SignNames(map, SignIds_))
{
  int size[3];
  map->GetDimensions(size);
  if (size[2] != 1)
  {
    throw Error("floor map", "it has more than one layer of points along z", "Extract a slice");
  }
  this->Size_[0] = static_cast<std::size_t>(size[0]);
  this->Size_[1] = static_cast<std::size_t>(size[1]);
  for (const std::string& name : this->SignNames_)
  {
    this->NameLength_ = std::max(this->NameLength_, name.size());
  }
  this->Define(map);
  this->WriteAxes(map);
}

//------------------------------------------------------------------------------
void FloorMapNetcdf::Define(vtkImageData* map)
{
  NetcdfFile& file = this->File_;
  const int time = file.Dimension("time", 0);
  const int sign = file.Dimension("sign", this->SignIds_.size());
  const int y = file.Dimension("y", this->Size_[1]);
  const int x = file.Dimension("x", this->Size_[0]);
  const int letter = file.Dimension("name_length", this->NameLength_);
  const auto describe = [&file](int variable, const char* unit, const char* name, const char* axis)
  {
    file.Attribute(variable, "units", unit);
    file.Attribute(variable, "long_name", name);
    if (axis)
    {
      file.Attribute(variable, "axis", axis);
    }
  };
  using Type = NetcdfFile::Type;
  this->Time_ = file.Variable("time", Type::Double, {time});
  // The conventions want a date, by which VTK and ParaView know the axis of time as well.
  describe(this->Time_, "seconds since 2000-01-01 00:00:00",
    "time of the fire simulation; the date stands for its zero", "T");
  file.Attribute(this->Time_, "standard_name", "time");
  file.Attribute(this->Time_, "calendar", "standard");
  this->Y_ = file.Variable("y", Type::Double, {y});
  describe(this->Y_, "m", "place along y", "Y");
  this->X_ = file.Variable("x", Type::Double, {x});
  describe(this->X_, "m", "place along x", "X");
  this->Z_ = file.Variable("z", Type::Double, {});
  describe(this->Z_, "m", "height of the eye", "Z");
  file.Attribute(this->Z_, "positive", "up");
  this->Sign_ = file.Variable("sign", Type::Integer, {sign});
  describe(this->Sign_, "1", "id of the sign", nullptr);
  this->Name_ = file.Variable("sign_name", Type::Character, {sign, letter});
  file.Attribute(this->Name_, "long_name", "name of the sign");
  for (const Quantity& quantity : Quantities())
  {
    vtkDataArray* const array = map->GetPointData()->GetArray(quantity.Array);
    const int components = quantity.EachSign ? static_cast<int>(this->SignIds_.size()) : 1;
    if (!array || array->GetNumberOfComponents() != components)
    {
      continue;
    }
    const std::vector<int> dimensions =
      quantity.EachSign ? std::vector<int>{time, sign, y, x} : std::vector<int>{time, y, x};
    const int variable = file.Variable(quantity.Name, quantity.Type, dimensions);
    describe(variable, quantity.Unit, quantity.LongName, nullptr);
    file.Attribute(variable, "coordinates", quantity.EachSign ? "z sign_name" : "z");
    if (std::string(quantity.Array) == "Status")
    {
      file.Attribute(variable, "flag_values", std::vector<int>{0, 1, 2, 3});
      file.Attribute(
        variable, "flag_meanings", "seen below_threshold no_sign_in_view inside_solid");
    }
    this->Fields_.push_back({quantity.Array, variable, quantity.EachSign});
  }
  file.Attribute(NetcdfFile::Whole, "Conventions", "CF-1.8");
  file.Attribute(NetcdfFile::Whole, "title", "Visibility of exit signs through smoke");
  file.Attribute(NetcdfFile::Whole, "source", "SmokeVisibility, FloorMapOfVisibility");
  if (vtkDataArray* const threshold = map->GetFieldData()->GetArray("ContrastThreshold"))
  {
    file.Attribute(NetcdfFile::Whole, "contrast_threshold", threshold->GetComponent(0, 0));
  }
  file.EndDefinitions();
}

//------------------------------------------------------------------------------
void FloorMapNetcdf::WriteAxes(vtkImageData* map)
{
  const auto places = [map](int axis, std::size_t count)
  {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = map->GetOrigin()[axis] +
                  map->GetSpacing()[axis] * static_cast<double>(i + map->GetExtent()[2 * axis]);
    }
    return values;
  };
  this->File_.Write(this->X_, {0}, {this->Size_[0]}, places(0, this->Size_[0]).data());
  this->File_.Write(this->Y_, {0}, {this->Size_[1]}, places(1, this->Size_[1]).data());
  this->File_.Write(this->Z_, {}, {}, places(2, 1).data());
  const std::vector<double> ids(this->SignIds_.begin(), this->SignIds_.end());
  this->File_.Write(this->Sign_, {0}, {ids.size()}, ids.data());
  for (std::size_t sign = 0; sign < this->SignNames_.size(); ++sign)
  {
    std::string name = this->SignNames_[sign];
    name.resize(this->NameLength_, '\0');
    this->File_.Write(this->Name_, {sign, 0}, {1, this->NameLength_}, name.c_str());
  }
}

//------------------------------------------------------------------------------
void FloorMapNetcdf::Add(double time, vtkImageData* map)
{
  const std::size_t places = this->Size_[0] * this->Size_[1];
  if (static_cast<std::size_t>(map->GetNumberOfPoints()) != places)
  {
    throw Error("floor map at " + std::to_string(time) + " s",
      "its number of places differs from that of the first map",
      "Give maps of one resolution for all times");
  }
  this->File_.Write(this->Time_, {this->Steps_}, {1}, &time);
  std::vector<double> values(places);
  for (const Field& field : this->Fields_)
  {
    const int components = field.EachSign ? static_cast<int>(this->SignIds_.size()) : 1;
    vtkDataArray* const array = SameArray(map, field.Array, time, components);
    for (int component = 0; component < components; ++component)
    {
      for (std::size_t i = 0; i < places; ++i)
      {
        values[i] = array->GetComponent(static_cast<vtkIdType>(i), component);
      }
      const auto sign = static_cast<std::size_t>(component);
      const std::vector<std::size_t> start = field.EachSign
                                               ? std::vector<std::size_t>{this->Steps_, sign, 0, 0}
                                               : std::vector<std::size_t>{this->Steps_, 0, 0};
      const std::vector<std::size_t> count =
        field.EachSign ? std::vector<std::size_t>{1, 1, this->Size_[1], this->Size_[0]}
                       : std::vector<std::size_t>{1, this->Size_[1], this->Size_[0]};
      this->File_.Write(field.Variable, start, count, values.data());
    }
  }
  ++this->Steps_;
}

//------------------------------------------------------------------------------
FloorMapTable::FloorMapTable(const std::string& path, vtkImageData* map)
    : Path_(path), SignIds_(SignIds(map)), SignNames_(SignNames(map, SignIds_))
{
  this->File_.open(path, std::ios::trunc);
  if (!this->File_)
  {
    throw Error("file '" + path + "'", "it cannot be made", "Check the folder and its permissions");
  }
  this->File_.imbue(std::locale::classic());
  this->File_ << std::setprecision(9) << "time_s,x_m,y_m,z_m,sign,sign_name";
  for (const Quantity& quantity : Quantities())
  {
    vtkDataArray* const array = map->GetPointData()->GetArray(quantity.Array);
    if (quantity.EachSign && array &&
        array->GetNumberOfComponents() == static_cast<int>(this->SignIds_.size()))
    {
      this->Arrays_.emplace_back(quantity.Array);
      this->File_ << "," << quantity.Name
                  << (std::string(quantity.Unit) == "cd m-2" ? "_cd_m2" : "");
    }
  }
  this->File_ << "\n";
  for (std::string& name : this->SignNames_)
  {
    std::string quoted = "\"";
    for (const char letter : name)
    {
      quoted += letter == '"' ? "\"\"" : std::string(1, letter);
    }
    name = quoted + "\"";
  }
}

//------------------------------------------------------------------------------
FloorMapTable::~FloorMapTable()
{
  if (!this->Finished_)
  {
    this->File_.close();
    std::remove(this->Path_.c_str());
  }
}

//------------------------------------------------------------------------------
void FloorMapTable::Add(double time, vtkImageData* map)
{
  const int signs = static_cast<int>(this->SignIds_.size());
  std::vector<vtkDataArray*> arrays;
  for (const std::string& name : this->Arrays_)
  {
    arrays.push_back(SameArray(map, name, time, signs));
  }
  for (vtkIdType place = 0; place < map->GetNumberOfPoints(); ++place)
  {
    double point[3];
    map->GetPoint(place, point);
    for (int sign = 0; sign < signs; ++sign)
    {
      this->File_ << time << "," << point[0] << "," << point[1] << "," << point[2] << ","
                  << this->SignIds_[sign] << "," << this->SignNames_[sign];
      for (vtkDataArray* const array : arrays)
      {
        this->File_ << "," << array->GetComponent(place, sign);
      }
      this->File_ << "\n";
    }
  }
}

//------------------------------------------------------------------------------
void FloorMapTable::Finish()
{
  this->File_.close();
  if (!this->File_)
  {
    throw Error("file '" + this->Path_ + "'", "not all of it could be written",
      "Check the space that is left");
  }
  this->Finished_ = true;
}

} // namespace smokevis
