#include "simulation/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "common/check.hpp"
#include "simulation/hull_geometry.hpp"
#include "simulation/nearest_point.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {
namespace {

constexpr unsigned kPacket = 4;
// Every x86-64 machine of the last fifteen years has this instruction set; Embree rounds differently with wider ones.
constexpr const char* kDeviceConfig = "isa=sse4.2,threads=1,start_threads=0,set_affinity=0";

struct Geometry {
  std::vector<Eigen::Vector3f> vertices;  // One more than used: Embree reads 16 bytes at a vertex.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What a query of Embree asks of each triangle near its point.
struct TriangleQuery {
  using Consider = bool (*)(TriangleQuery&, RTCPointQueryFunctionArguments&);
  explicit TriangleQuery(Consider consider_in, const std::vector<Geometry>& geometries_in)
      : consider(consider_in), geometries(&geometries_in) {}
  Consider consider;
  const std::vector<Geometry>* geometries;
};

struct SweepQuery : TriangleQuery {
  using TriangleQuery::TriangleQuery;
  Segment2d segment;
  double bottom_m, top_m;
  double radius_m;
  double half_height_m;
  double half_length_m;
  Clearance best;
};

std::array<Eigen::Vector3d, 3> corners(const Geometry& geometry, unsigned triangle) {
  const auto& index = geometry.triangles[triangle];
  return {geometry.vertices[index[0]].cast<double>(), geometry.vertices[index[1]].cast<double>(),
          geometry.vertices[index[2]].cast<double>()};
}

/// Radius of the sphere about the middle of the sweep that contains everything nearer than `distance_m`.
float queryRadius(const SweepQuery& query, double distance_m) {
  return static_cast<float>(
      std::hypot(query.half_length_m + query.radius_m + distance_m, query.half_height_m) * (1.0 + 1e-5) + 1e-5);
}

bool considerTriangle(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<TriangleQuery*>(arguments->userPtr);
  return query.consider(query, *arguments);
}

bool considerForSweep(TriangleQuery& any_query, RTCPointQueryFunctionArguments& arguments) {
  auto& query = static_cast<SweepQuery&>(any_query);
  const Slice slice(corners((*query.geometries)[arguments.geomID], arguments.primID), query.bottom_m, query.top_m);
  if (slice.empty()) return false;
  const Nearest2d nearest = slice.nearestTo(query.segment);
  const double distance_m = std::max(0.0, nearest.distance_m - query.radius_m);
  // Equal distances are ordered by number, so that the answer does not depend on the order of the tree.
  const int shape = static_cast<int>(arguments.geomID);
  if (distance_m > query.best.distance_m ||
      (distance_m == query.best.distance_m && query.best.shape != Hit::kNothing && shape >= query.best.shape))
    return false;
  query.best = {distance_m, shape, {nearest.point_m.x(), nearest.point_m.y(), slice.height_m()}};
  arguments.query->radius = queryRadius(query, distance_m);
  return true;
}

struct NearestQuery : TriangleQuery {
  using TriangleQuery::TriangleQuery;
  Eigen::Vector3d point_world_m;
  NearestSurface best;
};

bool considerForNearest(TriangleQuery& any_query, RTCPointQueryFunctionArguments& arguments) {
  auto& query = static_cast<NearestQuery&>(any_query);
  const auto triangle = corners((*query.geometries)[arguments.geomID], arguments.primID);
  const Eigen::Vector3d nearest = nearestPoint(triangle, query.point_world_m);
  const double distance_m = (nearest - query.point_world_m).norm();
  const int shape = static_cast<int>(arguments.geomID);
  if (distance_m > query.best.distance_m ||
      (distance_m == query.best.distance_m && query.best.shape != Hit::kNothing && shape >= query.best.shape))
    return false;
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  query.best = {distance_m, shape, nearest, normal.normalized()};
  arguments.query->radius = static_cast<float>(distance_m * (1.0 + 1e-5) + 1e-5);
  return true;
}

/// What Embree says of a hit.
struct RawHit {
  float distance_m;
  unsigned shape, triangle;
  Eigen::Vector3f normal;
  Eigen::Vector2f corner_shares;
};

Hit makeHit(const RawHit& raw, const Eigen::Vector3f& direction_world) {
  const Eigen::Vector3f unit = raw.normal.normalized();
  return {raw.distance_m, static_cast<int>(raw.shape), unit.dot(direction_world) > 0.0F ? -unit : unit,
          static_cast<int>(raw.triangle), raw.corner_shares};
}

/// Calls take(index of the ray, packet, place in the packet) for each ray.
template <typename Take>
void castPackets(RTCScene scene, std::span<const Ray> rays, double max_m, Take&& take) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min<std::size_t>(kPacket, rays.size() - first);
    RTCRayHit4 packet{};
    alignas(16) int valid[kPacket];
    for (std::size_t k = 0; k < kPacket; ++k) {
      const Ray& ray = rays[first + std::min(k, count - 1)];
      valid[k] = k < count ? -1 : 0;
      packet.ray.org_x[k] = ray.origin_world_m.x();
      packet.ray.org_y[k] = ray.origin_world_m.y();
      packet.ray.org_z[k] = ray.origin_world_m.z();
      packet.ray.dir_x[k] = ray.direction_world.x();
      packet.ray.dir_y[k] = ray.direction_world.y();
      packet.ray.dir_z[k] = ray.direction_world.z();
      packet.ray.tfar[k] = static_cast<float>(max_m);
      packet.ray.mask[k] = ~0U;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect4(valid, scene, &context, &packet);
    for (std::size_t k = 0; k < count; ++k) take(first + k, packet, k);
  }
}

/// Calls take(index of the ray, index of the actor, hit) for each hit within max_m.
template <typename Take>
void forEachActorHit(std::span<const Ray> rays, double max_m, std::span<const Actor> actors, Take&& take) {
  for (std::size_t a = 0; a < actors.size(); ++a) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const ActorHit hit =
          castOnActor(actors[a], rays[i].origin_world_m.cast<double>(), rays[i].direction_world.cast<double>());
      if (hit.distance_m <= max_m) take(i, a, hit);
    }
  }
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Geometry> geometries;
  std::vector<bool> mirrors;  ///< By shape; empty if none is a mirror.

  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void add(const Shape& shape) {
    geometries.push_back({shape.vertices_world_m, shape.triangles});
    geometries.back().vertices.emplace_back(0.0F, 0.0F, 0.0F);
  }

  void build() {
    device = rtcNewDevice(kDeviceConfig);
    SWIFTLET_CHECK(device != nullptr, static_cast<int>(rtcGetDeviceError(nullptr)));
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    for (const Geometry& geometry : geometries) attach(geometry);
    rtcCommitScene(scene);
    SWIFTLET_CHECK(rtcGetDeviceError(device) == RTC_ERROR_NONE);
  }

  void attach(const Geometry& geometry) {
    RTCGeometry handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(handle, RTC_BUILD_QUALITY_HIGH);
    rtcSetSharedGeometryBuffer(handle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, geometry.vertices.data(), 0,
                               sizeof(Eigen::Vector3f), geometry.vertices.size() - 1);
    rtcSetSharedGeometryBuffer(handle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, geometry.triangles.data(), 0,
                               sizeof(geometry.triangles[0]), geometry.triangles.size());
    rtcSetGeometryPointQueryFunction(handle, considerTriangle);
    rtcCommitGeometry(handle);
    rtcAttachGeometry(scene, handle);
    rtcReleaseGeometry(handle);
  }
};

RayCaster::RayCaster(const WorldModel& world) : impl_(std::make_unique<Impl>()) {
  for (const Shape& shape : world.shapes) impl_->add(shape);
  if (std::any_of(world.shapes.begin(), world.shapes.end(), [](const Shape& shape) { return shape.mirror; }))
    for (const Shape& shape : world.shapes) impl_->mirrors.push_back(shape.mirror);
  impl_->build();
}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

Hit RayCaster::cast(const Eigen::Vector3d& origin_world_m, const Eigen::Vector3d& direction_world, double max_m,
                    std::span<const Actor> actors) const {
  const Hit hit = castDirectly(origin_world_m, direction_world, max_m, actors);
  return isMirror(hit) ? reflected(origin_world_m, direction_world, max_m, actors, hit) : hit;
}

bool RayCaster::isMirror(const Hit& hit) const {
  const auto shape = static_cast<std::size_t>(hit.shape);
  return hit && shape < impl_->mirrors.size() && impl_->mirrors[shape];
}

Hit RayCaster::reflected(const Eigen::Vector3d& origin_world_m, const Eigen::Vector3d& direction_world, double max_m,
                         std::span<const Actor> actors, Hit hit) const {
  constexpr int kMostReflections = 8;  // Between two mirrors; bounds the work of a ray.
  constexpr double kStep_m = 1e-3;     // Off the surface: single-precision rays are coarser than it is exact.
  Eigen::Vector3d origin = origin_world_m, direction = direction_world;
  Eigen::Matrix3d as_seen = Eigen::Matrix3d::Identity();
  double passed_m = 0.0;
  for (int i = 0; i < kMostReflections && isMirror(hit); ++i) {
    const Eigen::Vector3d normal = hit.normal_world.cast<double>();
    origin += hit.distance_m * direction + kStep_m * normal;
    direction -= 2.0 * direction.dot(normal) * normal;
    as_seen *= Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose();
    passed_m += hit.distance_m;
    hit = passed_m < max_m ? castDirectly(origin, direction, max_m - passed_m, actors) : Hit{};
  }
  if (isMirror(hit)) return {};
  hit.distance_m += passed_m;  // Stays infinite where nothing is hit.
  hit.normal_world = (as_seen * hit.normal_world.cast<double>()).cast<float>();
  return hit;
}

Hit RayCaster::castDirectly(const Eigen::Vector3d& origin_world_m, const Eigen::Vector3d& direction_world, double max_m,
                            std::span<const Actor> actors) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  const Eigen::Vector3f origin = origin_world_m.cast<float>(), direction = direction_world.cast<float>();
  query.ray = {origin.x(),
               origin.y(),
               origin.z(),
               0.0F,
               direction.x(),
               direction.y(),
               direction.z(),
               0.0F,
               static_cast<float>(max_m),
               ~0U,
               0,
               0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &query);

  Hit hit;
  if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
    hit = makeHit({query.ray.tfar,
                   query.hit.geomID,
                   query.hit.primID,
                   {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z},
                   {query.hit.u, query.hit.v}},
                  direction);
  for (std::size_t i = 0; i < actors.size(); ++i) {
    const ActorHit on_actor = castOnActor(actors[i], origin_world_m, direction_world);
    if (on_actor.distance_m > max_m || on_actor.distance_m >= hit.distance_m) continue;
    hit = {on_actor.distance_m, static_cast<int>(impl_->geometries.size() + i), on_actor.normal.cast<float>()};
  }
  return hit;
}

void RayCaster::castAll(std::span<const Ray> rays, double max_m, std::span<const Actor> actors,
                        std::span<float> distances_m) const {
  SWIFTLET_CHECK(rays.size() == distances_m.size(), rays.size(), distances_m.size());
  if (!impl_->mirrors.empty()) {
    std::vector<Hit> hits(rays.size());
    castAll(rays, max_m, actors, hits);
    std::transform(hits.begin(), hits.end(), distances_m.begin(),
                   [](const Hit& hit) { return static_cast<float>(hit.distance_m); });
    return;
  }
  castPackets(impl_->scene, rays, max_m, [&](std::size_t i, const RTCRayHit4& packet, std::size_t k) {
    const bool missed = packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID;
    distances_m[i] = missed ? std::numeric_limits<float>::infinity() : packet.ray.tfar[k];
  });
  forEachActorHit(rays, max_m, actors, [&](std::size_t i, std::size_t, const ActorHit& hit) {
    distances_m[i] = std::min(distances_m[i], static_cast<float>(hit.distance_m));
  });
}

void RayCaster::castAll(std::span<const Ray> rays, double max_m, std::span<const Actor> actors,
                        std::span<Hit> hits) const {
  SWIFTLET_CHECK(rays.size() == hits.size(), rays.size(), hits.size());
  castPackets(impl_->scene, rays, max_m, [&](std::size_t i, const RTCRayHit4& packet, std::size_t k) {
    hits[i] = Hit{};
    if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) return;
    hits[i] = makeHit({packet.ray.tfar[k],
                       packet.hit.geomID[k],
                       packet.hit.primID[k],
                       {packet.hit.Ng_x[k], packet.hit.Ng_y[k], packet.hit.Ng_z[k]},
                       {packet.hit.u[k], packet.hit.v[k]}},
                      rays[i].direction_world);
  });
  forEachActorHit(rays, max_m, actors, [&](std::size_t i, std::size_t actor, const ActorHit& hit) {
    if (hit.distance_m < hits[i].distance_m)
      hits[i] = {hit.distance_m, static_cast<int>(impl_->geometries.size() + actor), hit.normal.cast<float>()};
  });
  if (impl_->mirrors.empty()) return;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (isMirror(hits[i]))
      hits[i] = reflected(rays[i].origin_world_m.cast<double>(), rays[i].direction_world.cast<double>(), max_m, actors,
                          hits[i]);
}

Clearance RayCaster::sweep(const Hull& hull, const Eigen::Vector3d& from_world_m, const Eigen::Vector3d& to_world_m,
                           double limit_m) const {
  const Eigen::Vector3d middle = 0.5 * (from_world_m + to_world_m);
  SweepQuery query(considerForSweep, impl_->geometries);
  query.segment = {from_world_m.head<2>(), to_world_m.head<2>()};
  query.bottom_m = std::min(from_world_m.z(), to_world_m.z()) - hull.half_height_m;
  query.top_m = std::max(from_world_m.z(), to_world_m.z()) + hull.half_height_m;
  query.radius_m = hull.radius_m;
  query.half_height_m = 0.5 * (query.top_m - query.bottom_m);
  query.half_length_m = 0.5 * (query.segment.to_m - query.segment.from_m).norm();
  query.best.distance_m = limit_m;

  RTCPointQuery point{static_cast<float>(middle.x()), static_cast<float>(middle.y()), static_cast<float>(middle.z()),
                      0.0F, queryRadius(query, limit_m)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene, &point, &context, nullptr, static_cast<TriangleQuery*>(&query));
  return query.best;
}

NearestSurface RayCaster::nearest(const Eigen::Vector3d& point_world_m, double limit_m) const {
  NearestQuery query(considerForNearest, impl_->geometries);
  query.point_world_m = point_world_m;
  query.best.distance_m = limit_m;
  const Eigen::Vector3f at = point_world_m.cast<float>();
  RTCPointQuery point{at.x(), at.y(), at.z(), 0.0F, static_cast<float>(limit_m * (1.0 + 1e-5) + 1e-5)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene, &point, &context, nullptr, static_cast<TriangleQuery*>(&query));
  return query.best;
}

}  // namespace swiftlet::simulation
