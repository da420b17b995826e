// Upright solids that are not part of the static world: people, the hulls of vehicles, doors. Each is tested exactly.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace swiftlet::simulation {

/// Something solid that moves, or comes and goes: an upright cylinder (a walking person, the hull of another vehicle),
/// or an upright box (a door).
struct Actor {
  Eigen::Vector2d position_world_m = Eigen::Vector2d::Zero();
  double radius_m = 0.25;  ///< 0 for a box.
  double bottom_m = 0.0;
  double top_m = 1.75;
  Eigen::Vector3f color{0.85F, 0.35F, 0.2F};  ///< For cameras: linear red, green, blue in [0, 1].
  /// Of a box, half its size along the axes that are turned by yaw_rad; zero for a cylinder.
  Eigen::Vector2d half_size_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;

  bool isBox() const { return half_size_m.x() > 0.0; }
};

/// The vehicle's hull: a solid upright cylinder, given by its centre.
struct Hull {
  double radius_m = 0.275;
  double half_height_m = 0.125;
};

struct ActorHit {
  double distance_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Where a ray first meets the actor, its direction of unit length; at distance 0 from inside.
ActorHit castOnActor(const Actor& actor, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

/// The point nearest to another one, seen from above: of a box, within its outline; of a cylinder, its axis.
Eigen::Vector2d nearestWithin(const Actor& actor, const Eigen::Vector2d& point_world_m);

/// Horizontal distance from the hull to the actor, 0 if they touch, infinity if one is above the other.
double gapTo_m(const Actor& actor, const Hull& hull, const Eigen::Vector3d& centre_world_m);

}  // namespace swiftlet::simulation
