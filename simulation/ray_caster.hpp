// Rays and hull against the world. Static triangles are in an Embree scene pinned to one instruction set, so that the
// same ray gives the same range on every machine. People, vehicles and doors are tested exactly and separately. A ray
// that meets a mirror goes on as it is reflected.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>

#include "simulation/actor.hpp"

namespace swiftlet::simulation {

struct WorldModel;

struct Ray {
  Eigen::Vector3f origin_world_m;
  Eigen::Vector3f direction_world;  ///< Unit length.
};

struct Hit {
  static constexpr int kNothing = -1;

  double distance_m = std::numeric_limits<double>::infinity();
  int shape = kNothing;  ///< Index into WorldModel::shapes; shapes.size() + k for actor k.
  Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();  ///< Unit, facing the origin of the ray.
  int triangle = 0;                                        ///< Index into the shape's triangles; 0 of an actor.
  /// The shares of the triangle's second and third corner in the point that was hit.
  Eigen::Vector2f corner_shares = Eigen::Vector2f::Zero();

  explicit operator bool() const { return shape != kNothing; }
};

/// The surface nearest to the hull. The distance is horizontal, to anything within the hull's height band.
struct Clearance {
  double distance_m = 0.0;  ///< 0 if they touch; the limit of the query if nothing is nearer.
  int shape = Hit::kNothing;
  Eigen::Vector3d point_world_m = Eigen::Vector3d::Zero();  ///< Nearest point; valid if `shape` is.
};

/// The surface nearest to a point, in all directions.
struct NearestSurface {
  double distance_m = 0.0;  ///< The limit of the query if nothing is nearer.
  int shape = Hit::kNothing;
  Eigen::Vector3d point_world_m = Eigen::Vector3d::Zero();  ///< Valid if `shape` is, as is the normal.
  Eigen::Vector3d normal_world = Eigen::Vector3d::UnitZ();  ///< Of its triangle; either side.
};

/// Const and without state: safe to use from several threads at once. In a mirror a ray sees the virtual image: the
/// distance is that along the reflected ray, and the normal is reflected back.
class RayCaster {
 public:
  explicit RayCaster(const WorldModel& world);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// The nearest surface within max_m along a unit direction; surfaces count from both sides.
  Hit cast(const Eigen::Vector3d& origin_world_m, const Eigen::Vector3d& direction_world, double max_m,
           std::span<const Actor> actors = {}) const;

  /// Distances only, infinity where nothing is within max_m; fastest for neighbouring rays in a row.
  /// `distances_m` has the size of `rays`.
  void castAll(std::span<const Ray> rays, double max_m, std::span<const Actor> actors,
               std::span<float> distances_m) const;
  /// The full hits, with shape and normal, within max_m.
  void castAll(std::span<const Ray> rays, double max_m, std::span<const Actor> actors, std::span<Hit> hits) const;

  /// The smallest horizontal distance between the static world and the hull while its centre moves along the segment
  /// from one point to another, up to limit_m. The hull sweeps the union of its height bands, so that no thin obstacle
  /// is missed between two steps.
  Clearance sweep(const Hull& hull, const Eigen::Vector3d& from_world_m, const Eigen::Vector3d& to_world_m,
                  double limit_m) const;

  /// The static surface nearest to a point, up to limit_m.
  NearestSurface nearest(const Eigen::Vector3d& point_world_m, double limit_m) const;

 private:
  /// The nearest surface, be it a mirror.
  Hit castDirectly(const Eigen::Vector3d& origin_world_m, const Eigen::Vector3d& direction_world, double max_m,
                   std::span<const Actor> actors) const;
  bool isMirror(const Hit& hit) const;
  /// What the ray sees whose nearest surface is `hit`.
  Hit reflected(const Eigen::Vector3d& origin_world_m, const Eigen::Vector3d& direction_world, double max_m,
                std::span<const Actor> actors, Hit hit) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::simulation
