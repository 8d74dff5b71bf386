#include "Geometry.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include <embree3/rtcore.h>

namespace smokevis
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Shapes that touch lie within this share of the size of the part of the scene that matters: well
/// below anything that matters to light; and at least within that share of the whole: well above
/// the rounding of the single precision that Embree works in.
constexpr double RelativeTolerance = 1e-5;
constexpr double RoundingShare = 1e-6;
/// Cosine of the angle between surfaces above which those that touch lie in one another.
constexpr double SamePlane = 0.999;

struct DeviceRelease
{
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease
{
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

/// Triangles of one kind, in double precision, with their search structure.
struct Shapes
{
  std::vector<Vec3> Corner, Normal;
  std::vector<std::uint32_t> Cell;
  /// Indices in the mesh.
  std::vector<std::size_t> Triangles;
  SceneHandle Tree;
};

/// Corners in an order of their own, by which equal triangles are found.
struct SortedTriangle
{
  std::array<Vec3, 3> Corner;
  std::size_t Index;

  std::array<double, 9> Key() const
  {
    return {this->Corner[0].x, this->Corner[0].y, this->Corner[0].z, this->Corner[1].x,
      this->Corner[1].y, this->Corner[1].z, this->Corner[2].x, this->Corner[2].y,
      this->Corner[2].z};
  }
};

/// Indices of the triangles that have an area and are not repeated, in their order.
std::vector<std::size_t> UsefulTriangles(const SurfaceMesh& mesh)
{
  std::vector<SortedTriangle> sorted;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    SortedTriangle triangle{{}, i};
    std::array<Vec3, 3>& corner = triangle.Corner;
    for (int c = 0; c < 3; ++c)
    {
      corner[c] = mesh.Points[mesh.Triangles[i][c]];
      if (!std::isfinite(corner[c].x) || !std::isfinite(corner[c].y) || !std::isfinite(corner[c].z))
      {
        throw Error("surface cell " + std::to_string(mesh.TriangleCell[i]),
          "a corner has no finite coordinates", "Check the geometry that is put in");
      }
    }
    const double longest = std::max({glm::length(corner[1] - corner[0]),
      glm::length(corner[2] - corner[1]), glm::length(corner[0] - corner[2])});
    const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    if (!(area > 1e-12 * longest * longest))
    {
      continue;
    }
    std::sort(corner.begin(), corner.end(),
      [](const Vec3& a, const Vec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
      });
    sorted.push_back(triangle);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
    [](const SortedTriangle& a, const SortedTriangle& b) { return a.Key() < b.Key(); });
  const auto end = std::unique(sorted.begin(), sorted.end(),
    [](const SortedTriangle& a, const SortedTriangle& b) { return a.Key() == b.Key(); });
  std::vector<std::size_t> kept;
  std::transform(sorted.begin(), end, std::back_inserter(kept),
    [](const SortedTriangle& triangle) { return triangle.Index; });
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// What Embree's filter callback adds to: every triangle that a line meets.
struct Gathering
{
  RTCIntersectContext Context;
  std::vector<std::pair<unsigned, float>>* Met;
};

void GatherAll(const RTCFilterFunctionNArguments* arguments)
{
  const auto* gathering = reinterpret_cast<const Gathering*>(arguments->context);
  gathering->Met->emplace_back(
    RTCHitN_primID(arguments->hit, arguments->N, 0), RTCRayN_tfar(arguments->ray, arguments->N, 0));
  // Not taken, so that the search goes on behind it.
  arguments->valid[0] = 0;
}

} // namespace

struct Geometry::Implementation
{
  DeviceHandle Device;
  Shapes Surfaces, Emitters;
  Vec3 Centre{0.0};
  double Tolerance = 0.0;

  void Add(Shapes& shapes, const SurfaceMesh& mesh) const
  {
    shapes.Triangles = UsefulTriangles(mesh);
    const std::vector<std::size_t>& triangles = shapes.Triangles;
    if (triangles.empty())
    {
      return;
    }
    RTCGeometry geometry = rtcNewGeometry(this->Device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
      0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.Points.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX,
      0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles.size()));
    if (vertices == nullptr || indices == nullptr)
    {
      rtcReleaseGeometry(geometry);
      throw Error("surfaces",
        "Embree has no memory for " + std::to_string(triangles.size()) + " triangles",
        "Use a coarser model or a machine with more memory");
    }
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        vertices[3 * i + axis] = static_cast<float>(mesh.Points[i][axis] - this->Centre[axis]);
      }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      const auto& triangle = mesh.Triangles[triangles[i]];
      shapes.Cell.push_back(mesh.TriangleCell[triangles[i]]);
      std::copy(triangle.begin(), triangle.end(), indices + 3 * i);
      const Vec3& corner = mesh.Points[triangle[0]];
      shapes.Corner.push_back(corner);
      shapes.Normal.push_back(glm::normalize(
        glm::cross(mesh.Points[triangle[1]] - corner, mesh.Points[triangle[2]] - corner)));
    }
    rtcCommitGeometry(geometry);
    shapes.Tree.reset(rtcNewScene(this->Device.get()));
    rtcSetSceneFlags(shapes.Tree.get(),
      static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcAttachGeometry(shapes.Tree.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(shapes.Tree.get());
  }

  /// A ray in Embree's units, moved forward in double precision so that its start is exact.
  static RTCRay MakeRay(const Vec3& origin, const Vec3& direction, double length)
  {
    RTCRay ray;
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0.0F;
    ray.tfar = static_cast<float>(length);
    ray.time = 0.0F;
    ray.mask = ~0U;
    ray.id = 0;
    ray.flags = 0;
    return ray;
  }

  /// Whether a ray begins and leads where single precision reaches. From beyond, a scene is less
  /// than a point, and Embree would end the program.
  static bool WithinReach(const RTCRay& ray)
  {
    const std::array<float, 6> values = {
      ray.org_x, ray.org_y, ray.org_z, ray.dir_x, ray.dir_y, ray.dir_z};
    return std::all_of(
      values.begin(), values.end(), [](float value) { return std::abs(value) < 1e18F; });
  }

  Hit IntersectOne(
    const Shapes& shapes, const Vec3& origin, const Vec3& direction, double begin, double end) const
  {
    Hit hit;
    if (!shapes.Tree || !(end > begin))
    {
      return hit;
    }
    RTCRayHit query;
    query.ray = MakeRay(origin + begin * direction - this->Centre, direction, end - begin);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (!WithinReach(query.ray))
    {
      return hit;
    }
    rtcIntersect1(shapes.Tree.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
    {
      return hit;
    }
    return this->MakeHit(
      shapes, origin, direction, begin, end, query.hit.primID, begin + query.ray.tfar);
  }

  /// A hit at a distance that is known to single precision.
  Hit MakeHit(const Shapes& shapes, const Vec3& origin, const Vec3& direction, double begin,
    double end, unsigned triangle, double rough) const
  {
    Hit hit;
    hit.Triangle = triangle;
    // The plane of the triangle gives the distance to double precision.
    const Vec3& normal = shapes.Normal[triangle];
    const double facing = glm::dot(normal, direction);
    const double exact = glm::dot(normal, shapes.Corner[triangle] - origin) / facing;
    hit.Distance = std::abs(exact - rough) <= 100.0 * this->Tolerance ? exact : rough;
    hit.Distance = std::clamp(hit.Distance, begin, end);
    hit.Side = facing < 0.0 ? 0 : 1;
    return hit;
  }

  /// All hits of a line, nearest first.
  void IntersectAll(const Shapes& shapes, const Vec3& origin, const Vec3& direction, double begin,
    double end, bool emitter, std::vector<Hit>& hits) const
  {
    hits.clear();
    if (!shapes.Tree || !(end > begin))
    {
      return;
    }
    thread_local std::vector<std::pair<unsigned, float>> met;
    met.clear();
    RTCRayHit query;
    query.ray = MakeRay(origin + begin * direction - this->Centre, direction, end - begin);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Gathering gathering;
    rtcInitIntersectContext(&gathering.Context);
    gathering.Context.filter = GatherAll;
    gathering.Met = &met;
    if (!WithinReach(query.ray))
    {
      return;
    }
    rtcIntersect1(shapes.Tree.get(), &gathering.Context, &query);
    for (const auto& [triangle, distance] : met)
    {
      hits.push_back(
        this->MakeHit(shapes, origin, direction, begin, end, triangle, begin + distance));
      hits.back().Emitter = emitter;
    }
    std::sort(hits.begin(), hits.end(),
      [](const Hit& a, const Hit& b)
      { return a.Distance != b.Distance ? a.Distance < b.Distance : a.Triangle < b.Triangle; });
  }

  /// Whether a plate that was hit lies in the surface that was hit, to within the tolerance.
  bool Touch(const Hit& surface, const Hit& plate, const Vec3& direction) const
  {
    const double facing = std::abs(glm::dot(this->Emitters.Normal[plate.Triangle], direction));
    return std::abs(plate.Distance - surface.Distance) * facing <= this->Tolerance;
  }

  /// Of the surfaces that a line meets within a gap, the first of the model of those that lie in
  /// the nearest one, or in the farthest, whichever way rounding falls.
  Hit FirstOfModel(std::vector<Hit>::const_iterator nearest, std::vector<Hit>::const_iterator end,
    double gap, bool farthest) const
  {
    if (nearest == end)
    {
      return {};
    }
    const auto behind = std::find_if(
      nearest, end, [&](const Hit& hit) { return hit.Distance > nearest->Distance + gap; });
    Hit first = farthest ? *(behind - 1) : *nearest;
    const Vec3 normal = this->Surfaces.Normal[first.Triangle];
    for (auto other = nearest; other != behind; ++other)
    {
      const bool inside =
        std::abs(glm::dot(normal, this->Surfaces.Normal[other->Triangle])) > SamePlane;
      first = inside && other->Triangle < first.Triangle ? *other : first;
    }
    return first;
  }

  /// The surface and the plate that a ray meets first; a plate farther than the surface is only
  /// looked for as deep as it can still touch it.
  void IntersectBoth(const Vec3& origin, const Vec3& direction, double begin, double end,
    Hit& surface, Hit& plate) const
  {
    surface = this->IntersectOne(this->Surfaces, origin, direction, begin, end);
    const double reach = std::min(end, surface.Distance + 20.0 * this->Tolerance);
    plate = this->IntersectOne(this->Emitters, origin, direction, begin, reach);
    plate.Emitter = true;
  }

  bool OccludedBy(
    const Shapes& shapes, const Vec3& origin, const Vec3& direction, double begin, double end) const
  {
    if (!shapes.Tree || !(end > begin))
    {
      return false;
    }
    RTCRay ray = MakeRay(origin + begin * direction - this->Centre, direction, end - begin);
    if (!WithinReach(ray))
    {
      return false;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(shapes.Tree.get(), &context, &ray);
    return ray.tfar < 0.0F;
  }
};

Geometry::Geometry() : Implementation_(std::make_unique<Implementation>())
{
}

Geometry::Geometry(
  const SurfaceMesh& surfaces, const SurfaceMesh& emitters, double sceneSize, double coreSize)
    : Geometry()
{
  Implementation& self = *this->Implementation_;
  Vec3 lower(Infinity);
  Vec3 upper(-Infinity);
  for (const SurfaceMesh* mesh : {&surfaces, &emitters})
  {
    for (const Vec3& point : mesh->Points)
    {
      lower = glm::min(lower, point);
      upper = glm::max(upper, point);
    }
  }
  if (surfaces.Points.empty() && emitters.Points.empty())
  {
    return;
  }
  self.Centre = 0.5 * (lower + upper);
  const double size = std::max(sceneSize, glm::length(upper - lower));
  self.Tolerance = std::max(
    RelativeTolerance * (coreSize > 0.0 ? std::min(coreSize, size) : size), RoundingShare * size);
  self.Device.reset(rtcNewDevice("set_affinity=0"));
  if (!self.Device)
  {
    throw Error("surfaces", "Embree could not be started", "Check that the machine has SSE2");
  }
  self.Add(self.Surfaces, surfaces);
  self.Add(self.Emitters, emitters);
}

Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

bool Geometry::Empty() const
{
  return !this->Implementation_->Surfaces.Tree && !this->Implementation_->Emitters.Tree;
}

double Geometry::Tolerance() const
{
  return this->Implementation_->Tolerance;
}

const std::vector<std::size_t>& Geometry::SurfaceTriangles() const
{
  return this->Implementation_->Surfaces.Triangles;
}

const std::vector<std::size_t>& Geometry::EmitterTriangles() const
{
  return this->Implementation_->Emitters.Triangles;
}

std::uint32_t Geometry::Cell(const Hit& hit) const
{
  const Implementation& self = *this->Implementation_;
  return (hit.Emitter ? self.Emitters : self.Surfaces).Cell[hit.Triangle];
}

Vec3 Geometry::Normal(const Hit& hit) const
{
  const Implementation& self = *this->Implementation_;
  return (hit.Emitter ? self.Emitters : self.Surfaces).Normal[hit.Triangle];
}

Hit Geometry::Intersect(const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  const Implementation& self = *this->Implementation_;
  Hit surface;
  Hit plate;
  self.IntersectBoth(origin, direction, begin, end, surface, plate);
  if (!plate.Found())
  {
    return surface;
  }
  // A plate mounted on a wall is seen from its front only, whichever way rounding falls.
  if (surface.Found() && self.Touch(surface, plate, direction))
  {
    return plate.Side == 0 ? plate : surface;
  }
  return plate.Distance < surface.Distance ? plate : surface;
}

void Geometry::Cross(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::vector<Crossing>& crossings) const
{
  const Implementation& self = *this->Implementation_;
  crossings.clear();
  const double gap = 2.0 * self.Tolerance;
  const auto otherSide = [](Hit hit)
  {
    hit.Side = 1 - hit.Side;
    return hit;
  };
  thread_local std::vector<Hit> surfaces;
  thread_local std::vector<Hit> plates;
  self.IntersectAll(self.Surfaces, origin, direction, begin, end, false, surfaces);
  self.IntersectAll(self.Emitters, origin, direction, begin, end, true, plates);
  auto nextSurface = surfaces.begin();
  auto nextPlate = plates.begin();
  while (end > begin)
  {
    const auto behind = [begin](const Hit& hit) { return hit.Distance >= begin; };
    nextSurface = std::find_if(nextSurface, surfaces.end(), behind);
    nextPlate = std::find_if(nextPlate, plates.end(), behind);
    // Where a line cuts an edge, it comes out of another surface than it went into: taken for one,
    // they would let it into a closed box, or out.
    const Hit surface = self.FirstOfModel(nextSurface, surfaces.end(), gap, false);
    const Hit last = self.FirstOfModel(nextSurface, surfaces.end(), gap, true);
    const Hit plate = nextPlate == plates.end() ? Hit() : *nextPlate;
    if (!surface.Found() && !plate.Found())
    {
      return;
    }
    Crossing crossing;
    if (surface.Found() && plate.Found() && self.Touch(surface, plate, direction))
    {
      crossing.Arrive = plate.Side == 0 ? plate : surface;
      crossing.Leave = otherSide(plate.Side == 0 ? last : plate);
    }
    else
    {
      const bool onPlate = plate.Distance < surface.Distance;
      crossing.Arrive = onPlate ? plate : surface;
      crossing.Leave = otherSide(onPlate ? plate : last);
    }
    begin = std::max(crossing.Arrive.Distance, crossing.Leave.Distance) + gap;
    // A line meets a plane triangle once: a second time is rounding at grazing incidence.
    const bool again = !crossings.empty() &&
                       crossings.back().Arrive.Triangle == crossing.Arrive.Triangle &&
                       crossings.back().Arrive.Emitter == crossing.Arrive.Emitter;
    if (!again)
    {
      crossings.push_back(crossing);
    }
  }
}

bool Geometry::Occluded(const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  const Implementation& self = *this->Implementation_;
  return self.OccludedBy(self.Surfaces, origin, direction, begin, end) ||
         self.OccludedBy(self.Emitters, origin, direction, begin, end);
}

bool Geometry::Visible(const Vec3& from, const Vec3& to) const
{
  const double length = glm::length(to - from);
  // Single precision places a far shape to a share of its distance.
  const double gap = std::max(2.0 * this->Tolerance(), 2e-6 * length);
  if (length <= 2.0 * gap)
  {
    return true;
  }
  return !this->Occluded(from, (to - from) / length, gap, length - gap);
}

} // namespace smokevis
