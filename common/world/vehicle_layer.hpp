// The World's layer of the vehicle: where it is, was and will be, and what it does. New at every snapshot.
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
  std::string name;  ///< Empty while it is the only one.
  VehicleState state;
  FlightState flight_state = FlightState::kPreparation;
  double distance_flown_m = 0.0;  ///< By the estimate.
  AvoidanceStatus avoidance;
  Pose2 home_map;                            ///< The take-off pose; the identity, as that is where `map` begins.
  Trail trail;                               ///< Where it has been, thinned.
  std::vector<Eigen::Vector2d> plan_map_m;   ///< What is left of the path being flown.
  std::shared_ptr<const LaserPoints> laser;  ///< May be null: the last projected scan.
};

}  // namespace swiftlet::common
