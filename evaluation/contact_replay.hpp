// Would the contact with a person have come, too, if the vehicle had stood still, or landed? The last seconds before it
// are flown again, with the people as they walked.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::evaluation {

/// The truth at one tick.
struct ReplayTick {
  common::Time stamp;
  Eigen::Vector3d position_world_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world_m_s = Eigen::Vector3d::Zero();
  double above_floor_m = 0.0;                   ///< Of the body over the place where it stood last.
  std::vector<Eigen::Vector2d> people_world_m;  ///< The same people in each tick.
};

struct ContactReplay {
  /// How long before the contact the vehicle decides otherwise.
  static constexpr double kBefore_s = 2.0;

  bool standing = false;  ///< Somebody touches the vehicle that brakes and stands.
  bool landing = false;   ///< Somebody touches the vehicle that brakes and lands before its motors are off.
};

/// From the first tick on; the contact is at the last one. After it the people go on as they walked there. A person of
/// whom the vehicle's centre is as far as of the nearest one at the contact touches it. Nothing remains without ticks
/// or people.
ContactReplay replay(std::span<const ReplayTick> ticks);

}  // namespace swiftlet::evaluation
