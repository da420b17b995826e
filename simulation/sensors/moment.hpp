// The track of a vehicle and the people around it, for sensors that measure during a span of time.
#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::simulation {

/// The poses of the vehicle and the walkers at one instant.
struct Moment {
  common::Time time;
  common::Pose3 T_world_body;
  std::vector<Actor> actors;
};

}  // namespace swiftlet::simulation
