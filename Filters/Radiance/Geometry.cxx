#include "Geometry.h"

#include "Errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
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

/// What Embree's filter callback adds to: every triangle that a line meets.
struct Gathering
{
  RTCIntersectContext Context;
  std::vector<std::pair<std::uint32_t, float>>* Met;
};

void GatherAll(const RTCFilterFunctionNArguments* arguments)
{
  const auto* gathering = reinterpret_cast<const Gathering*>(arguments->context);
  gathering->Met->emplace_back(
    RTCHitN_primID(arguments->hit, arguments->N, 0), RTCRayN_tfar(arguments->ray, arguments->N, 0));
  // Not taken, so that the search goes on behind it.
  arguments->valid[0] = 0;
}

/// A ray in Embree's units, whose start was moved forward in double precision so that it is exact.
/// None where it begins or leads beyond what single precision reaches: from there a scene is less
/// than a point, and Embree would end the program.
std::optional<RTCRay> MakeRay(const RayPiece& piece, const SinglePrecision& units)
{
  const Vec3 origin = units.Place(piece.Origin + piece.Begin * piece.Direction);
  const Vec3& direction = piece.Direction;
  const double length = units.Length(piece.End - piece.Begin);
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
  const std::array<float, 6> values = {
    ray.org_x, ray.org_y, ray.org_z, ray.dir_x, ray.dir_y, ray.dir_z};
  const bool within =
    std::all_of(values.begin(), values.end(), [](float value) { return std::abs(value) < 1e18F; });
  return within && length > 0.0 ? std::optional<RTCRay>(ray) : std::nullopt;
}

/// Rays of one packet: as many as the widest registers hold. Narrower machines take them in parts.
constexpr std::size_t PacketSize = 16;

RTCRayHit MakeQuery(const RTCRay& ray)
{
  RTCRayHit query;
  query.ray = ray;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

/// Rays that are traced at once.
struct Packet
{
  /// Nothing lies on a ray that ends before it begins.
  Packet() { std::fill(std::begin(this->Rays.tfar), std::end(this->Rays.tfar), -1.0F); }

  RTCRay16 Rays{};
  /// Those that count: -1, others: 0.
  alignas(64) std::array<int, PacketSize> Valid{};

  void Set(std::size_t number, const RTCRay& ray)
  {
    this->Valid[number] = -1;
    this->Rays.org_x[number] = ray.org_x;
    this->Rays.org_y[number] = ray.org_y;
    this->Rays.org_z[number] = ray.org_z;
    this->Rays.dir_x[number] = ray.dir_x;
    this->Rays.dir_y[number] = ray.dir_y;
    this->Rays.dir_z[number] = ray.dir_z;
    this->Rays.tnear[number] = ray.tnear;
    this->Rays.tfar[number] = ray.tfar;
    this->Rays.time[number] = ray.time;
    this->Rays.mask[number] = ray.mask;
    this->Rays.id[number] = ray.id;
    this->Rays.flags[number] = ray.flags;
  }
};

} // namespace

TriangleTree::Device TriangleTree::NewDevice()
{
  RTCDevice device = rtcNewDevice("set_affinity=0");
  if (device == nullptr)
  {
    throw Error("surfaces", "Embree could not be started", "Check that the machine has SSE2");
  }
  return {device, rtcReleaseDevice};
}

TriangleTree::TriangleTree(const Device& device, const SurfaceMesh& mesh, bool emitters,
  const SinglePrecision& units, double tolerance)
    : Triangles_(UsefulTriangles(mesh)), Units_(units), Tolerance_(tolerance), Emitters_(emitters)
{
  if (this->Triangles_.empty())
  {
    return;
  }
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.Points.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
    RTC_FORMAT_UINT3, 3 * sizeof(unsigned), this->Triangles_.size()));
  if (vertices == nullptr || indices == nullptr)
  {
    rtcReleaseGeometry(geometry);
    throw Error("surfaces",
      "Embree has no memory for " + std::to_string(this->Triangles_.size()) + " triangles",
      "Use a coarser model or a machine with more memory");
  }
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const Vec3 place = units.Place(mesh.Points[i]);
    for (int axis = 0; axis < 3; ++axis)
    {
      vertices[3 * i + axis] = static_cast<float>(place[axis]);
    }
  }
  for (std::size_t i = 0; i < this->Triangles_.size(); ++i)
  {
    const auto& triangle = mesh.Triangles[this->Triangles_[i]];
    this->Cells_.push_back(mesh.TriangleCell[this->Triangles_[i]]);
    std::copy(triangle.begin(), triangle.end(), indices + 3 * i);
    const Vec3& corner = mesh.Points[triangle[0]];
    this->Corners_.push_back(corner);
    this->Normals_.push_back(glm::normalize(
      glm::cross(mesh.Points[triangle[1]] - corner, mesh.Points[triangle[2]] - corner)));
  }
  this->Vertices_ = vertices;
  this->Indices_ = indices;
  rtcCommitGeometry(geometry);
  // Embree 3 uses the device while it takes a scene apart, but holds on to it only until then: it
  // has to end after the scene.
  this->Tree_ = {rtcNewScene(device.get()), [device](RTCScene scene) { rtcReleaseScene(scene); }};
  rtcSetSceneFlags(this->Tree_.get(),
    static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcAttachGeometry(this->Tree_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->Tree_.get());
}

Hit TriangleTree::MakeHit(const Vec3& origin, const Vec3& direction, double begin, double end,
  std::uint32_t triangle, double rough) const
{
  Hit hit;
  hit.Triangle = triangle;
  hit.Emitter = this->Emitters_;
  // The plane of the triangle gives the distance to double precision.
  const Vec3& normal = this->Normals_[triangle];
  const double facing = glm::dot(normal, direction);
  const double exact = glm::dot(normal, this->Corners_[triangle] - origin) / facing;
  hit.Distance = std::abs(exact - rough) <= 100.0 * this->Tolerance_ ? exact : rough;
  hit.Distance = std::clamp(hit.Distance, begin, end);
  hit.Side = facing < 0.0 ? 0 : 1;
  return hit;
}

Hit TriangleTree::Intersect(
  const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  const std::optional<RTCRay> ray = MakeRay({origin, direction, begin, end}, this->Units_);
  if (this->Empty() || !ray)
  {
    return {};
  }
  RTCRayHit query = MakeQuery(*ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(this->Tree_.get(), &context, &query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID
           ? Hit()
           : this->MakeHit(origin, direction, begin, end, query.hit.primID,
               begin + this->Units_.Metres(query.ray.tfar));
}

void TriangleTree::IntersectAll(
  const Vec3& origin, const Vec3& direction, double begin, double end, std::vector<Hit>& hits) const
{
  hits.clear();
  const std::optional<RTCRay> ray = MakeRay({origin, direction, begin, end}, this->Units_);
  if (this->Empty() || !ray)
  {
    return;
  }
  thread_local std::vector<std::pair<std::uint32_t, float>> met;
  met.clear();
  RTCRayHit query = MakeQuery(*ray);
  Gathering gathering;
  rtcInitIntersectContext(&gathering.Context);
  gathering.Context.filter = GatherAll;
  gathering.Met = &met;
  rtcIntersect1(this->Tree_.get(), &gathering.Context, &query);
  for (const auto& [triangle, distance] : met)
  {
    hits.push_back(this->MakeHit(
      origin, direction, begin, end, triangle, begin + this->Units_.Metres(distance)));
  }
  std::sort(hits.begin(), hits.end(),
    [](const Hit& a, const Hit& b)
    { return a.Distance != b.Distance ? a.Distance < b.Distance : a.Triangle < b.Triangle; });
}

bool TriangleTree::Occluded(
  const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  std::optional<RTCRay> ray = MakeRay({origin, direction, begin, end}, this->Units_);
  if (this->Empty() || !ray)
  {
    return false;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(this->Tree_.get(), &context, &*ray);
  return ray->tfar < 0.0F;
}

std::vector<bool> TriangleTree::Clear(
  std::initializer_list<const TriangleTree*> trees, std::span<const RayPiece> pieces)
{
  std::vector<bool> clear(pieces.size(), true);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < pieces.size(); first += PacketSize)
  {
    const std::size_t count = std::min(PacketSize, pieces.size() - first);
    Packet packet;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (const auto ray = MakeRay(pieces[first + i], (*trees.begin())->Units_))
      {
        packet.Set(i, *ray);
      }
    }
    for (const TriangleTree* tree : trees)
    {
      if (tree->Empty())
      {
        continue;
      }
      rtcOccluded16(packet.Valid.data(), tree->Tree_.get(), &context, &packet.Rays);
      for (std::size_t i = 0; i < count; ++i)
      {
        if (packet.Valid[i] != 0 && packet.Rays.tfar[i] < 0.0F)
        {
          packet.Valid[i] = 0;
          clear[first + i] = false;
        }
      }
    }
  }
  return clear;
}

bool TriangleTree::AllNear(
  const Vec3& place, double radius, const std::function<bool(const Triangle&)>& holds) const
{
  if (this->Empty())
  {
    return true;
  }
  struct Question
  {
    const TriangleTree& Tree;
    const std::function<bool(const Triangle&)>& Holds;
    bool OfAll = true;
  };
  Question question{*this, holds};
  const auto ask = [](RTCPointQueryFunctionArguments* arguments)
  {
    auto& asked = *static_cast<Question*>(arguments->userPtr);
    Triangle corners;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const std::size_t point = asked.Tree.Indices_[3 * std::size_t{arguments->primID} + corner];
      const float* const at = asked.Tree.Vertices_ + 3 * point;
      corners[corner] = asked.Tree.Units_.PlaceOf(Vec3(at[0], at[1], at[2]));
    }
    if (asked.OfAll && asked.Holds(corners))
    {
      return false;
    }
    asked.OfAll = false;
    // Nothing is that near: the search ends.
    arguments->query->radius = 0.0F;
    return true;
  };
  const Vec3 centre = this->Units_.Place(place);
  RTCPointQuery query;
  query.x = static_cast<float>(centre.x);
  query.y = static_cast<float>(centre.y);
  query.z = static_cast<float>(centre.z);
  query.time = 0.0F;
  query.radius = static_cast<float>(this->Units_.Length(radius));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(this->Tree_.get(), &query, &context, ask, &question);
  return question.OfAll;
}

Geometry::Geometry(
  const SurfaceMesh& surfaces, const SurfaceMesh& emitters, double sceneSize, double coreSize)
{
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
  const double size = std::max(sceneSize, glm::length(upper - lower));
  this->Rounding_ = RoundingShare * size;
  this->Tolerance_ = std::max(
    RelativeTolerance * (coreSize > 0.0 ? std::min(coreSize, size) : size), this->Rounding_);
  const SinglePrecision units(0.5 * (lower + upper), size);
  const TriangleTree::Device device = TriangleTree::NewDevice();
  this->Surfaces_ = TriangleTree(device, surfaces, false, units, this->Tolerance_);
  this->Emitters_ = TriangleTree(device, emitters, true, units, this->Tolerance_);
}

bool Geometry::Touch(const Hit& surface, const Hit& plate, const Vec3& direction) const
{
  const double facing = std::abs(glm::dot(this->Emitters_.Normal(plate.Triangle), direction));
  return std::abs(plate.Distance - surface.Distance) * facing <= this->Tolerance_;
}

void Geometry::IntersectBoth(const Vec3& origin, const Vec3& direction, double begin, double end,
  Hit& surface, Hit& plate) const
{
  surface = this->Surfaces_.Intersect(origin, direction, begin, end);
  const double reach = std::min(end, surface.Distance + 20.0 * this->Tolerance_);
  plate = this->Emitters_.Intersect(origin, direction, begin, reach);
}

Hit Geometry::Intersect(const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  Hit surface;
  Hit plate;
  this->IntersectBoth(origin, direction, begin, end, surface, plate);
  if (!plate.Found())
  {
    return surface;
  }
  // A plate mounted on a wall is seen from its front only, whichever way rounding falls.
  if (surface.Found() && this->Touch(surface, plate, direction))
  {
    return plate.Side == 0 ? plate : surface;
  }
  return plate.Distance < surface.Distance ? plate : surface;
}

bool Geometry::Occluded(const Vec3& origin, const Vec3& direction, double begin, double end) const
{
  return this->Surfaces_.Occluded(origin, direction, begin, end) ||
         this->Emitters_.Occluded(origin, direction, begin, end);
}

RayPiece Geometry::Between(const Vec3& from, const Vec3& to) const
{
  const double length = glm::length(to - from);
  // Single precision places a far shape to a share of its distance.
  const double gap = std::max(2.0 * this->Tolerance_, 2e-6 * length);
  return {from, (to - from) / length, gap, length - gap};
}

bool Geometry::Visible(const Vec3& from, const Vec3& to) const
{
  const RayPiece between = this->Between(from, to);
  return !this->Occluded(between.Origin, between.Direction, between.Begin, between.End);
}

std::vector<bool> Geometry::Visible(std::span<const LineOfSight> lines) const
{
  if (this->Empty())
  {
    return std::vector<bool>(lines.size(), true);
  }
  std::vector<RayPiece> pieces;
  pieces.reserve(lines.size());
  for (const LineOfSight& line : lines)
  {
    pieces.push_back(this->Between(line.From, line.To));
  }
  return TriangleTree::Clear({&this->Surfaces_, &this->Emitters_}, pieces);
}

bool Geometry::SeesBacks(const Vec3& point, std::span<const Vec3> directions) const
{
  bool backs = false;
  for (const Vec3& direction : directions)
  {
    const Hit hit = this->Intersect(point, direction, 0.0, std::numeric_limits<double>::infinity());
    if (!hit.Found() || (!hit.Emitter && hit.Side == 0))
    {
      return false;
    }
    backs = backs || !hit.Emitter;
  }
  return backs;
}

} // namespace smokevis
