// A hand that takes the vehicle, carries it aside and turns it, and releases it: it moves the vehicle whatever its
// controller does.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/time.hpp"

namespace swiftlet::simulation {

class Quadrotor;

/// Takes the vehicle at `time_s`, and releases it at rest after `lasts_s`.
struct HandConfig {
  double time_s = 0.0;
  double lasts_s = 2.0;
  double x_m = 0.0;  ///< How far it carries the vehicle, along the world's axes.
  double y_m = 0.0;
  double yaw_deg = 0.0;  ///< How far it turns the vehicle, counterclockwise.

  void describe(common::config::Fields& fields);
};

class Hand {
 public:
  explicit Hand(const HandConfig& config) : config_(config) {}

  /// Moves the vehicle in the step that begins at `now`; nothing while it does not hold it, and while it stands.
  void lead(common::Time now, Quadrotor& quadrotor);

 private:
  struct Grip {
    Eigen::Vector2d position_world_m;
    double yaw_rad;
  };
  HandConfig config_;
  std::optional<Grip> grip_;  ///< Where it took the vehicle.
};

}  // namespace swiftlet::simulation
