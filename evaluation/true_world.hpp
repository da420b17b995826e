// The true world of a flight, as its scorer needs it.
#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/vehicle_config.hpp"
#include "evaluation/target_score.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::evaluation {

/// Clearance and bound of the reachable area for trials without their own.
inline constexpr double kClearance_m = 0.10;
/// A larger area means that the world is open.
inline constexpr double kReachableAreaMax_m2 = 2000.0;

/// The world of this flight, after the seed's variation, as the scorer needs it.
struct TrueWorld {
  const simulation::RayCaster* rays = nullptr;
  common::VehicleConfig vehicle;
  common::LaserConfig laser;
  std::optional<common::RgbdCameraConfig> rgbd_camera;  ///< Of a vehicle that carries one.
  common::Pose3 T_body_camera;                          ///< True mount of the RGB-D camera.
  double camera_clock_offset_s = 0.0;                   ///< How late the camera's clock is at the end.
  std::vector<TrueTarget> targets;                      ///< Targets that the trial asks for.
  simulation::QuadrotorConfig quadrotor;
  double clearance_m = kClearance_m;  ///< Clearance of the mission. Places where the hull does not fit with it are not
                                      ///< expected to be reached.
  double reachable_area_max_m2 = kReachableAreaMax_m2;  ///< A world with a larger reachable area counts as open.
};

}  // namespace swiftlet::evaluation
