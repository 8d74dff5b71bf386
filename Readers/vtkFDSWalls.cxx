#include "vtkFDSWalls.h"

#include "SmvFile.h"
#include "SrgbColor.h"
#include "WallBuilder.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <vector>

namespace smokevis
{

//------------------------------------------------------------------------------------------------
bool BuildWalls(const SmvFile& index, double time, double leastOpacity, vtkPolyData* output)
{
  WallBuilder builder(index, time, leastOpacity);
  const std::vector<WallQuad> quads = builder.Build();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkFloatArray> reflectance;
  reflectance->SetName("Reflectance");
  reflectance->SetNumberOfComponents(3);
  vtkNew<vtkStringArray> names;
  names->SetName("SurfaceName");
  for (const WallQuad& quad : quads)
  {
    polygons->InsertNextCell(4);
    for (const std::array<double, 3>& corner : quad.Corners())
    {
      polygons->InsertCellPoint(points->InsertNextPoint(corner.data()));
    }
    const WallMaterial& material = builder.Materials()[quad.Material];
    std::array<float, 3> linear{};
    std::transform(material.Color.begin(), material.Color.end(), linear.begin(),
      [](double part) { return static_cast<float>(LinearFromSrgb(part)); });
    reflectance->InsertNextTypedTuple(linear.data());
    names->InsertNextValue(index.Surfaces[material.Surface].Name);
  }
  output->SetPoints(points);
  output->SetPolys(polygons);
  output->GetCellData()->AddArray(reflectance);
  output->GetCellData()->AddArray(names);
  return builder.FoundMirror();
}

} // namespace smokevis
