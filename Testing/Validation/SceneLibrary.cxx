#include "SceneLibrary.h"

#include "Places.h"
#include "ReferenceIntegrator.h"
#include "Triangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace smokevis::scenes
{

namespace
{

struct Face
{
  Vec3 Corner, EdgeU, EdgeV;
};

/// Faces of a box with fronts inwards: low x, high x, low y, high y, low z, high z.
std::array<Face, 6> InwardFaces(const Vec3& lower, const Vec3& upper)
{
  const Vec3 size = upper - lower;
  const Vec3 x(size.x, 0.0, 0.0);
  const Vec3 y(0.0, size.y, 0.0);
  const Vec3 z(0.0, 0.0, size.z);
  return {Face{lower, y, z}, Face{lower + x, z, y}, Face{lower, z, x}, Face{lower + y, x, z},
    Face{lower, x, y}, Face{lower + z, y, x}};
}

int Pieces(const Vec3& edge, double patchSize)
{
  return std::max(1, static_cast<int>(std::ceil(glm::length(edge) / patchSize - 1e-9)));
}

} // namespace

//--------------------------------------------------------------------------------------------------
std::size_t AddRectangle(SurfaceMesh& mesh, const Vec3& corner, const Vec3& edgeU,
  const Vec3& edgeV, int nu, int nv, double reflectance)
{
  const std::size_t firstCell = mesh.CellReflectance.size();
  const auto firstPoint = static_cast<std::uint32_t>(mesh.Points.size());
  for (int j = 0; j <= nv; ++j)
  {
    for (int i = 0; i <= nu; ++i)
    {
      mesh.Points.push_back(
        corner + edgeU * (static_cast<double>(i) / nu) + edgeV * (static_cast<double>(j) / nv));
    }
  }
  const auto row = static_cast<std::uint32_t>(nu + 1);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const std::uint32_t a =
        firstPoint + static_cast<std::uint32_t>(j) * row + static_cast<std::uint32_t>(i);
      const auto cell = static_cast<std::uint32_t>(mesh.CellReflectance.size());
      mesh.Triangles.push_back({a, a + 1, a + 1 + row});
      mesh.Triangles.push_back({a, a + 1 + row, a + row});
      mesh.TriangleCell.insert(mesh.TriangleCell.end(), 2, cell);
      mesh.CellReflectance.push_back({reflectance, reflectance, reflectance});
    }
  }
  return firstCell;
}

//--------------------------------------------------------------------------------------------------
void AddRoom(
  SurfaceMesh& mesh, const Vec3& lower, const Vec3& upper, double patchSize, double reflectance)
{
  for (const Face& face : InwardFaces(lower, upper))
  {
    AddRectangle(mesh, face.Corner, face.EdgeU, face.EdgeV, Pieces(face.EdgeU, patchSize),
      Pieces(face.EdgeV, patchSize), reflectance);
  }
}

//--------------------------------------------------------------------------------------------------
void AddBlock(
  SurfaceMesh& mesh, const Vec3& lower, const Vec3& upper, double patchSize, double reflectance)
{
  for (const Face& face : InwardFaces(lower, upper))
  {
    AddRectangle(mesh, face.Corner, face.EdgeV, face.EdgeU, Pieces(face.EdgeV, patchSize),
      Pieces(face.EdgeU, patchSize), reflectance);
  }
}

//--------------------------------------------------------------------------------------------------
std::vector<double> Linear(double first, double last, int intervals)
{
  std::vector<double> nodes;
  for (int i = 0; i <= intervals; ++i)
  {
    nodes.push_back(first + (last - first) * i / intervals);
  }
  return nodes;
}

//--------------------------------------------------------------------------------------------------
SmokeGrid UniformSmoke(
  const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells, double extinction)
{
  SmokeGrid grid;
  grid.Name = "uniform smoke";
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Nodes[axis] = Linear(lower[axis], upper[axis], cells[axis]);
    count *= static_cast<std::size_t>(cells[axis]);
  }
  grid.Extinction.assign(count, static_cast<float>(extinction));
  return grid;
}

//--------------------------------------------------------------------------------------------------
SmokeGrid NoisySmoke(const Vec3& lower, const Vec3& upper, const std::array<int, 3>& cells,
  double low, double high, std::uint64_t seed)
{
  SmokeGrid grid = UniformSmoke(lower, upper, cells, 0.0);
  grid.Name = "noisy smoke";
  Pcg32 random(seed, 1);
  for (float& extinction : grid.Extinction)
  {
    extinction = static_cast<float>(low + (high - low) * random.Uniform());
  }
  return grid;
}

//--------------------------------------------------------------------------------------------------
void AddFlame(SmokeGrid& grid, const std::array<int, 2>& first, double luminance)
{
  const std::size_t row = grid.Nodes[0].size() - 1;
  const std::size_t layer = row * (grid.Nodes[1].size() - 1);
  grid.EmittedLuminance.assign(grid.Extinction.size(), 0.0F);
  ForEachPlace({2, 2, 4},
    [&](const std::array<int, 3>& place)
    {
      const std::size_t cell = static_cast<std::size_t>(first[0] + place[0]) +
                               row * static_cast<std::size_t>(first[1] + place[1]) +
                               layer * static_cast<std::size_t>(place[2]);
      grid.Extinction[cell] = 2.0F;
      grid.EmittedLuminance[cell] = static_cast<float>(luminance);
    });
}

//--------------------------------------------------------------------------------------------------
std::pair<SmokeGrid, SmokeGrid> Split(const SmokeGrid& grid, int axis, int node)
{
  std::pair<SmokeGrid, SmokeGrid> parts;
  std::array<int, 3> size{};
  for (int a = 0; a < 3; ++a)
  {
    size[a] = static_cast<int>(grid.Nodes[a].size()) - 1;
  }
  parts.first.Name = grid.Name + ", low part";
  parts.second.Name = grid.Name + ", high part";
  parts.first.Nodes = parts.second.Nodes = grid.Nodes;
  const auto cut = grid.Nodes[axis].begin() + node;
  parts.first.Nodes[axis].assign(grid.Nodes[axis].begin(), cut + 1);
  parts.second.Nodes[axis].assign(cut, grid.Nodes[axis].end());
  std::size_t cell = 0;
  ForEachPlace(size,
    [&](const std::array<int, 3>& place)
    {
      SmokeGrid& part = place[axis] < node ? parts.first : parts.second;
      part.Extinction.push_back(grid.Extinction[cell]);
      if (!grid.EmittedLuminance.empty())
      {
        part.EmittedLuminance.push_back(grid.EmittedLuminance[cell]);
      }
      ++cell;
    });
  return parts;
}

//--------------------------------------------------------------------------------------------------
EmitterCell Plate(const Vec3& centre, const Vec3& normal, const Vec3& up, double width,
  double height, double luminance, double reflectance, int signId)
{
  const Vec3 right = glm::normalize(glm::cross(up, normal)) * (0.5 * width);
  const Vec3 top = glm::normalize(glm::cross(normal, right)) * (0.5 * height);
  EmitterCell cell;
  cell.Vertices = {
    centre - right - top, centre + right - top, centre + right + top, centre - right + top};
  cell.Luminance = {luminance, luminance, luminance};
  cell.Reflectance = {reflectance, reflectance, reflectance};
  cell.SignId = signId;
  return cell;
}

SceneDescription Corridor(double extinction, int lamps, double albedo, double reflectance)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  const Vec3 upper(60, 4, 4);
  scene.Grids = {UniformSmoke(Vec3(0.0), upper, {120, 8, 8}, extinction)};
  AddRoom(scene.Surfaces, Vec3(0.0), upper, 2.0, reflectance);
  for (int lamp = 0; lamp < lamps; ++lamp)
  {
    const Vec3 centre(60.0 * (lamp + 0.5) / lamps, 2.0, 3.99);
    scene.Emitters.push_back(Plate(centre, {0, 0, -1}, {1, 0, 0}, 0.3, 0.3, 1000.0, 0.0));
  }
  return scene;
}

//--------------------------------------------------------------------------------------------------
SceneDescription LayeredCorridor(double height, double albedo, double reflectance)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  const Vec3 upper(30.0, 2.4, 2.7);
  SmokeGrid grid = UniformSmoke(Vec3(0.0), upper, {150, 12, 15}, 0.1);
  std::fill(grid.Extinction.begin() + std::size_t{11} * 12 * 150, grid.Extinction.end(), 1.0F);
  scene.Grids = {grid};
  AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.6, reflectance);
  scene.Emitters =
    Barcode({29.99, 1.2, height}, {-1, 0, 0}, {0, 0, 1}, 0.6, 0.3, 9, 200.0, 0, 0.5 * reflectance);
  return scene;
}

//--------------------------------------------------------------------------------------------------
SceneDescription FlameBehindADoor()
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  const Vec3 upper(6.0, 3.0, 2.5);
  SmokeGrid grid = UniformSmoke(Vec3(0.0), upper, {24, 12, 10}, 0.2);
  AddFlame(grid, {3, 7}, 2000.0);
  scene.Grids = {grid};
  AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.3, 0.5);
  AddBlock(scene.Surfaces, {3, 0, 0}, {3.25, 1, 2.5}, 0.3, 0.5);
  AddBlock(scene.Surfaces, {3, 2, 0}, {3.25, 3, 2.5}, 0.3, 0.5);
  AddBlock(scene.Surfaces, {3, 1, 2}, {3.25, 2, 2.5}, 0.3, 0.5);
  scene.Emitters = Barcode({5.98, 2.4, 1.8}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 5, 20.0, 0);
  return scene;
}

//--------------------------------------------------------------------------------------------------
std::vector<EmitterCell> Barcode(const Vec3& centre, const Vec3& normal, const Vec3& up,
  double width, double height, int bars, double luminance, int signId, double reflectance)
{
  const Vec3 right = glm::normalize(glm::cross(up, normal));
  std::vector<EmitterCell> cells;
  for (int bar = 0; bar < bars; ++bar)
  {
    const double offset = width * ((bar + 0.5) / bars - 0.5);
    cells.push_back(Plate(centre + right * offset, normal, up, width / bars, height,
      bar % 2 == 0 ? luminance : 0.0, reflectance, signId));
  }
  return cells;
}

//--------------------------------------------------------------------------------------------------
std::vector<EmitterCell> EmittingRectangle(const Vec3& corner, const Vec3& edgeU, const Vec3& edgeV,
  int nu, int nv, double luminance, double reflectance, int signId)
{
  std::vector<EmitterCell> cells;
  const auto at = [&](int i, int j) {
    return corner + edgeU * (static_cast<double>(i) / nu) + edgeV * (static_cast<double>(j) / nv);
  };
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      EmitterCell cell;
      cell.Vertices = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      cell.Luminance = {luminance, luminance, luminance};
      cell.Reflectance = {reflectance, reflectance, reflectance};
      cell.SignId = signId;
      cells.push_back(cell);
    }
  }
  return cells;
}

//--------------------------------------------------------------------------------------------------
std::vector<EmitterCell> EmittingRoom(
  const Vec3& lower, const Vec3& upper, int n, double luminance, double reflectance)
{
  std::vector<EmitterCell> cells;
  int sign = 0;
  for (const Face& face : InwardFaces(lower, upper))
  {
    const auto wall =
      EmittingRectangle(face.Corner, face.EdgeU, face.EdgeV, n, n, luminance, reflectance, sign++);
    cells.insert(cells.end(), wall.begin(), wall.end());
  }
  return cells;
}

//--------------------------------------------------------------------------------------------------
std::vector<EmitterCell> EmittingSphere(
  const Vec3& centre, double radius, int cuts, bool inwards, double luminance, double reflectance)
{
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> points;
  for (const double s : {-1.0, 1.0})
  {
    for (const double t : {-golden, golden})
    {
      points.emplace_back(0.0, s, t);
      points.emplace_back(s, t, 0.0);
      points.emplace_back(t, 0.0, s);
    }
  }
  std::vector<Triangle> triangles;
  // The faces of an icosahedron with edge 2 are the triples of corners at that distance.
  const auto joined = [&](std::size_t a, std::size_t b)
  { return std::abs(glm::length(points[a] - points[b]) - 2.0) < 1e-9; };
  for (std::size_t a = 0; a < points.size(); ++a)
  {
    for (std::size_t b = a + 1; b < points.size(); ++b)
    {
      for (std::size_t c = b + 1; c < points.size(); ++c)
      {
        if (joined(a, b) && joined(b, c) && joined(a, c))
        {
          triangles.push_back(
            {glm::normalize(points[a]), glm::normalize(points[b]), glm::normalize(points[c])});
        }
      }
    }
  }
  for (int cut = 0; cut < cuts; ++cut)
  {
    std::vector<Triangle> finer;
    for (const Triangle& t : triangles)
    {
      const Vec3 ab = glm::normalize(t[0] + t[1]);
      const Vec3 bc = glm::normalize(t[1] + t[2]);
      const Vec3 ca = glm::normalize(t[2] + t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  double volume = 0.0;
  double surface = 0.0;
  for (const Triangle& t : triangles)
  {
    volume += std::abs(glm::dot(t[0], glm::cross(t[1], t[2]))) / 6.0;
    surface += AreaOf(t);
  }
  const double scale = radius * surface / (3.0 * volume);
  std::vector<EmitterCell> cells;
  for (Triangle& t : triangles)
  {
    const bool outward = glm::dot(AreaVector(t), t[0]) > 0.0;
    if (outward == inwards)
    {
      std::swap(t[1], t[2]);
    }
    EmitterCell cell;
    cell.Vertices = {centre + t[0] * scale, centre + t[1] * scale, centre + t[2] * scale};
    cell.Luminance = {luminance, luminance, luminance};
    cell.Reflectance = {reflectance, reflectance, reflectance};
    cells.push_back(cell);
  }
  return cells;
}

//--------------------------------------------------------------------------------------------------
SceneDescription Tunnel(double extinction, double albedo)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  const Vec3 lower(0.0);
  const Vec3 upper(4.0, 1.0, 1.0);
  scene.Grids.push_back(UniformSmoke(lower, upper, {40, 10, 10}, extinction));
  AddRoom(scene.Surfaces, lower, upper, 0.1, 0.2);
  scene.Emitters = Barcode({4.0, 0.5, 0.5}, {-1, 0, 0}, {0, 0, 1}, 0.3, 0.3, 9, 1.0, 0);
  return scene;
}

//--------------------------------------------------------------------------------------------------
EmitterCell TunnelLamp(double x)
{
  return Plate({x, 0.5, 1.0}, {0, 0, -1}, {1, 0, 0}, 0.2, 0.2, 1.0);
}

//--------------------------------------------------------------------------------------------------
SceneDescription FurnishedRoom(double albedo, double extinction)
{
  SceneDescription scene;
  scene.Albedo = albedo;
  const Vec3 upper(4, 3, 2.5);
  if (extinction > 0.0)
  {
    scene.Grids = {
      NoisySmoke(Vec3(0.0), upper, {24, 18, 15}, 0.5 * extinction, 1.5 * extinction, 2)};
  }
  AddRoom(scene.Surfaces, Vec3(0.0), upper, 0.25, 0.5);
  AddBlock(scene.Surfaces, {1.5, 1, 0}, {2, 1.5, 1}, 0.25, 0.3);
  scene.Emitters = Barcode({4, 1.5, 1.875}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.25, 5, 100.0, 0, 0.1);
  scene.Emitters.push_back(Plate({1, 1, 2}, {0, 0, -1}, {1, 0, 0}, 0.5, 0.5, 20.0, 0.6));
  return scene;
}

//--------------------------------------------------------------------------------------------------
Slab MakeSlab(double opticalDepth, double albedo, int layers)
{
  // Light that reaches the middle from beyond the margin has crossed eight mean free paths of
  // smoke, or leaked through the faces for twice the thickness: less than 1e-3 of the fluence.
  const double margin = 8.0 / opticalDepth + 2.0;
  const double half = margin / 0.6;
  // In white smoke light would spread too fast through wide columns, to the open sides: those of
  // ten mean free paths lost 2 % of what comes through 16.
  constexpr double widest = 5.0;
  const int across =
    10 * std::max(2, static_cast<int>(std::ceil(0.2 * half * opticalDepth / widest)));
  Slab slab;
  slab.Layers = layers;
  SceneDescription& scene = slab.Description;
  scene.Albedo = albedo;
  scene.Grids.push_back(
    UniformSmoke({-half, -half, 0}, {half, half, 1}, {across, across, layers}, opticalDepth));
  const Vec3 u(2.0 * half, 0, 0);
  const Vec3 v(0, 2.0 * half, 0);
  AddRectangle(scene.Surfaces, {-half, -half, 1}, v, u, across, across, 0.0);
  scene.Emitters =
    EmittingRectangle({-half, -half, 0}, u, v, across, across, std::numbers::inv_pi, 0.0);

  // Those nearer to the middle than 0.4 of the half width.
  const int first = across * 3 / 10;
  slab.MiddleCells.resize(static_cast<std::size_t>(layers));
  for (int j = first; j < across - first; ++j)
  {
    for (int i = first; i < across - first; ++i)
    {
      const int flat = i + across * j;
      for (int layer = 0; layer < layers; ++layer)
      {
        slab.MiddleCells[static_cast<std::size_t>(layer)].push_back(
          flat + static_cast<std::int64_t>(across) * across * layer);
      }
      slab.FarPatches.push_back(static_cast<std::size_t>(flat));
      slab.NearPatches.push_back(static_cast<std::size_t>(across * across + flat));
    }
  }
  return slab;
}

} // namespace smokevis::scenes
