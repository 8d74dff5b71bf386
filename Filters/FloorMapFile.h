// A series of floor maps as a NetCDF file and as a table, for evacuation models.
#pragma once

#include "NetcdfFile.h"

#include <fstream>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace smokevis
{

/// The NetCDF file. Names and units follow the CF conventions; vtkFloorMapWriter says what is in
/// it.
class FloorMapNetcdf
{
public:
  /// Lays the file out for maps like this one.
  FloorMapNetcdf(const std::string& path, vtkImageData* map);
  /// Adds a map. Throws Error where it differs from the first one in size or arrays.
  void Add(double time, vtkImageData* map);
  void Finish() { this->File_.Finish(); }

private:
  struct Field
  {
    std::string Array;
    int Variable;
    bool EachSign;
  };
  void Define(vtkImageData* map);
  void WriteAxes(vtkImageData* map);

  NetcdfFile File_;
  std::size_t Size_[2] = {0, 0};
  std::vector<int> SignIds_;
  std::vector<std::string> SignNames_;
  std::size_t NameLength_ = 1;
  int Time_ = 0, X_ = 0, Y_ = 0, Z_ = 0, Sign_ = 0, Name_ = 0;
  std::vector<Field> Fields_;
  std::size_t Steps_ = 0;
};

/// The table, a row a time, place and sign, as comma-separated values.
class FloorMapTable
{
public:
  FloorMapTable(const std::string& path, vtkImageData* map);
  ~FloorMapTable();
  FloorMapTable(const FloorMapTable&) = delete;
  FloorMapTable& operator=(const FloorMapTable&) = delete;
  void Add(double time, vtkImageData* map);
  void Finish();

private:
  std::string Path_;
  std::ofstream File_;
  std::vector<int> SignIds_;
  std::vector<std::string> SignNames_, Arrays_;
  bool Finished_ = false;
};

} // namespace smokevis
