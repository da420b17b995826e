// What is around a place where a vehicle may start.
#pragma once

#include <Eigen/Core>

#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// The terrain above a point: one beneath it is inside the ground. Null without terrain above.
const Shape* terrainAbove(const WorldModel& world, const RayCaster& rays, const Eigen::Vector3d& point_world_m);

/// Compares places near a start that is blocked.
class StartSurroundings {
 public:
  /// The start is given at the height of the body on the floor, `flight_height_m` is above that.
  StartSurroundings(const RayCaster& rays, const Hull& hull, const Eigen::Vector3d& start_world_m,
                    double flight_height_m);

  /// 0: the place is on the same side of all walls as the start, has walls around it, and has room for the vehicle to
  /// fly about. Higher numbers are worse.
  int drawbacksOf(const Eigen::Vector3d& place_world_m) const;

 private:
  bool seesStart(const Eigen::Vector3d& flying_world_m) const;
  bool isEnclosed(const Eigen::Vector3d& flying_world_m) const;

  const RayCaster& rays_;
  Hull hull_;
  Eigen::Vector3d start_world_m_;
  double flight_height_m_;
  int blocking_;  ///< The shape that touches the start, or Hit::kNothing.
};

}  // namespace swiftlet::simulation
