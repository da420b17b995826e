#include "simulation/actor.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace swiftlet::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The side, top or bottom of an upright cylinder.
ActorHit castOnCylinder(const Actor& actor, const Vector3d& origin, const Vector3d& direction) {
  const Vector2d o = origin.head<2>() - actor.position_world_m, d = direction.head<2>();
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - actor.radius_m * actor.radius_m;
  ActorHit hit;
  if (c <= 0.0 && origin.z() >= actor.bottom_m && origin.z() <= actor.top_m) return {0.0, -direction};
  const double discriminant = b * b - a * c;
  if (a > 0.0 && discriminant >= 0.0) {
    const double t = (-b - std::sqrt(discriminant)) / a;
    const double z = origin.z() + t * direction.z();
    if (t >= 0.0 && z >= actor.bottom_m && z <= actor.top_m) {
      const Vector2d normal = (o + t * d) / actor.radius_m;
      return {t, {normal.x(), normal.y(), 0.0}};
    }
  }
  for (const double height_m : {actor.top_m, actor.bottom_m}) {
    if (direction.z() == 0.0) break;
    const double t = (height_m - origin.z()) / direction.z();
    if (t >= 0.0 && t < hit.distance_m && (o + t * d).squaredNorm() <= actor.radius_m * actor.radius_m)
      hit = {t, {0.0, 0.0, direction.z() < 0.0 ? 1.0 : -1.0}};
  }
  return hit;
}

/// The part of the ray within the slab between each two opposite sides; what all slabs have in common is in the box.
ActorHit castOnBox(const Actor& box, const Vector3d& origin, const Vector3d& direction) {
  const Eigen::Rotation2Dd R_world_box(box.yaw_rad);
  Vector3d o(0.0, 0.0, origin.z() - 0.5 * (box.top_m + box.bottom_m)), d = direction;
  o.head<2>() = R_world_box.inverse() * (origin.head<2>() - box.position_world_m);
  d.head<2>() = R_world_box.inverse() * direction.head<2>();
  const Vector3d half(box.half_size_m.x(), box.half_size_m.y(), 0.5 * (box.top_m - box.bottom_m));
  double enter_m = 0.0, leave_m = std::numeric_limits<double>::infinity();
  int side = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0 && std::abs(o[axis]) > half[axis]) return {};
    if (d[axis] == 0.0) continue;
    const double far = std::copysign(half[axis], d[axis]);
    const double in_m = (-far - o[axis]) / d[axis];
    leave_m = std::min(leave_m, (far - o[axis]) / d[axis]);
    if (in_m <= enter_m) continue;
    enter_m = in_m;
    side = axis;
  }
  if (enter_m > leave_m) return {};
  if (side < 0) return {0.0, -direction};
  Vector3d normal = Vector3d::Zero();
  normal[side] = d[side] > 0.0 ? -1.0 : 1.0;
  normal.head<2>() = R_world_box * normal.head<2>().eval();
  return {enter_m, normal};
}

}  // namespace

ActorHit castOnActor(const Actor& actor, const Vector3d& origin, const Vector3d& direction) {
  return actor.isBox() ? castOnBox(actor, origin, direction) : castOnCylinder(actor, origin, direction);
}

Vector2d nearestWithin(const Actor& actor, const Vector2d& point_world_m) {
  if (!actor.isBox()) return actor.position_world_m;
  const Eigen::Rotation2Dd R_world_box(actor.yaw_rad);
  const Vector2d at = R_world_box.inverse() * (point_world_m - actor.position_world_m);
  const Vector2d within = at.cwiseMax(-actor.half_size_m).cwiseMin(actor.half_size_m);
  return actor.position_world_m + R_world_box * within;
}

double gapTo_m(const Actor& actor, const Hull& hull, const Vector3d& centre_world_m) {
  const double z = centre_world_m.z();
  if (z - hull.half_height_m > actor.top_m || z + hull.half_height_m < actor.bottom_m)
    return std::numeric_limits<double>::infinity();
  const Vector2d at = centre_world_m.head<2>();
  return std::max(0.0, (nearestWithin(actor, at) - at).norm() - hull.radius_m - actor.radius_m);
}

}  // namespace swiftlet::simulation
