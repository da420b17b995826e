// The World's layer of the vehicle: its state, trail, plan and last scan. New at every snapshot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/vehicle_state.hpp"
#include "common/world/avoidance_status.hpp"
#include "common/world/flight_state.hpp"
#include "common/world/trail.hpp"

namespace swiftlet::common {

/// The end points of the last scan.
struct LaserPoints {
  std::vector<Eigen::Vector2f> points_map_m;
};

struct VehicleLayer {
  std::string name;  ///< Empty if there is only one vehicle.
  VehicleState state;
  FlightState flight_state = FlightState::kPreparation;
  double distance_flown_m = 0.0;  ///< Length of the estimated path.
  /// Standard deviation of the horizontal position, gathered since the take-off while the laser did not fix it in every
  /// direction. It falls where the vehicle sees again what it mapped before.
  double drift_m = 0.0;
  AvoidanceStatus avoidance;
  Pose2 home_map;                            ///< The take-off pose; the identity, because it defines `map`.
  Trail trail;                               ///< Where it has been, thinned.
  std::vector<Eigen::Vector2d> plan_map_m;   ///< The rest of the path being flown.
  std::shared_ptr<const LaserPoints> laser;  ///< The last projected scan; may be null.
};

}  // namespace swiftlet::common
