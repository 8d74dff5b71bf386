// The measured spread of lamps' light as arrays of polydata.
#pragma once

#include "IntensityTable.h"

#include <vtkPolyData.h>

#include <map>
#include <memory>
#include <string>

class vtkDataArray;

namespace smokevis
{

/// Intensity tables of the cells of a block of emitters. The cell array `PhotometryIndex` holds the
/// number i of each cell's table, or -1; the table is in the field data `Photometry<i>Polar` and
/// `Photometry<i>Azimuth` [degrees], `Photometry<i>Intensity` [cd] (all polar angles of the first
/// azimuth, then of the next). The cell array `PhotometryAxis`, 3 components, is the direction of
/// azimuth 0.
class PhotometricArrays
{
public:
  /// Throws Error for arrays that are incomplete or hold no table.
  PhotometricArrays(vtkPolyData& block, const std::string& blockName);

  /// A cell's table, or null.
  std::shared_ptr<const IntensityTable> Table(vtkIdType cell) const;
  Vec3 Axis(vtkIdType cell) const;

  /// Adds a table, with intensities in cd, to the field data. Returns its number, which is made
  /// from its values, so that tables of data sets that are appended stay apart.
  static int AddTable(vtkPolyData& block, const std::vector<double>& polar,
    const std::vector<double>& azimuth, const std::vector<double>& intensity);

  static constexpr const char* IndexName = "PhotometryIndex";
  static constexpr const char* AxisName = "PhotometryAxis";

private:
  vtkDataArray* Index_;
  vtkDataArray* Axis_;
  std::map<int, std::shared_ptr<const IntensityTable>> Tables_;
};

} // namespace smokevis
