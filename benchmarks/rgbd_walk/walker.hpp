// Somebody who walks through a building with a camera in the hand, looks around and stops at places.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::rgbd_walk {

/// Steps of 20 cm and turns of 20 degrees in a fifth of a second, as people make them.
struct WalkConfig {
  double speed_m_s = 1.0;
  double turn_rate_rad_s = 1.75;
  double height_m = 1.4;      ///< Of the camera over the floor of the start.
  double clearance_m = 0.45;  ///< Of the person.
  double length_m = 30.0;
};

/// The poses of the camera (x along the view, z up) every kWalkStep_s, from place to place of the building that are
/// drawn by the seed. Paths lead around everything that the person would touch. Throws std::runtime_error if the start
/// of the world leaves no room.
inline constexpr double kWalkStep_s = 0.005;
std::vector<common::Pose3> walkThrough(const simulation::WorldModel& world, const simulation::RayCaster& rays,
                                       const WalkConfig& config, std::uint64_t seed);

}  // namespace swiftlet::rgbd_walk
