// Reads routes from polydata and tables.
#include "RouteInput.h"

#include "Errors.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <map>
#include <string>

namespace smokevis
{
namespace
{

/// The numeric array with one of some names, whatever their capital letters; or null.
vtkDataArray* Find(vtkFieldData* data, std::initializer_list<const char*> names)
{
  for (const char* const name : names)
  {
    for (int i = 0; data && i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = data->GetArray(i);
      std::string given = array && array->GetName() ? array->GetName() : "";
      std::transform(given.begin(), given.end(), given.begin(),
        [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
      if (given == name)
      {
        return array;
      }
    }
  }
  return nullptr;
}

std::vector<RouteCorners> FromPolyData(vtkPolyData& data)
{
  vtkDataArray* const times = Find(data.GetPointData(), {"time"});
  std::vector<RouteCorners> routes;
  const auto add = [&](RouteCorners& route, vtkIdType point)
  {
    Vec3 corner;
    data.GetPoint(point, &corner.x);
    route.Corners.push_back(corner);
    if (times)
    {
      route.Times.push_back(times->GetComponent(point, 0));
    }
  };
  const auto iterator = vtk::TakeSmartPointer(data.GetLines()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    iterator->GetCurrentCell(count, ids);
    RouteCorners& route = routes.emplace_back();
    for (vtkIdType i = 0; i < count; ++i)
    {
      add(route, ids[i]);
    }
  }
  if (routes.empty())
  {
    RouteCorners& route = routes.emplace_back();
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    {
      add(route, i);
    }
  }
  return routes;
}

std::vector<RouteCorners> FromTable(vtkTable& table)
{
  vtkFieldData* const columns = table.GetRowData();
  vtkDataArray* const x = Find(columns, {"x"});
  vtkDataArray* const y = Find(columns, {"y"});
  if (!x || !y)
  {
    throw Error("Route", "the table has no columns x and y of numbers",
      "Give x and y [m], and where known z [m], time [s] and a number of the route");
  }
  vtkDataArray* const z = Find(columns, {"z"});
  vtkDataArray* const times = Find(columns, {"time", "t"});
  vtkDataArray* const numbers = Find(columns, {"route", "person", "id"});
  std::map<double, RouteCorners> routes;
  for (vtkIdType row = 0; row < table.GetNumberOfRows(); ++row)
  {
    RouteCorners& route = routes[numbers ? numbers->GetComponent(row, 0) : 0.0];
    route.Corners.emplace_back(
      x->GetComponent(row, 0), y->GetComponent(row, 0), z ? z->GetComponent(row, 0) : 0.0);
    if (times)
    {
      route.Times.push_back(times->GetComponent(row, 0));
    }
  }
  std::vector<RouteCorners> result;
  for (auto& [number, route] : routes)
  {
    result.push_back(std::move(route));
  }
  return result;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<RouteCorners> ReadRoutes(vtkDataObject* input)
{
  std::vector<RouteCorners> routes;
  if (auto* const data = vtkPolyData::SafeDownCast(input))
  {
    routes = FromPolyData(*data);
  }
  else if (auto* const table = vtkTable::SafeDownCast(input))
  {
    routes = FromTable(*table);
  }
  routes.erase(std::remove_if(routes.begin(), routes.end(),
                 [](const RouteCorners& route) { return route.Corners.size() < 2; }),
    routes.end());
  if (routes.empty())
  {
    throw Error("Route", "it holds no line of at least two points",
      "Give a polyline, such as Poly Line Source makes, or a table with columns x and y");
  }
  return routes;
}

} // namespace smokevis
