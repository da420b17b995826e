// The returns of one sweep, each placed by the pose that the body had when its beam was fired.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// A beam that has returned, in the frame of the poses.
struct PlacedReturn {
  Eigen::Vector3d origin_m;  ///< The laser at the time of the beam.
  Eigen::Vector3d end_m;
};

/// In the order of the beams, with all six degrees of freedom of the poses. Never fails: beams without a return, with a
/// range that is invalid, or that end nearer to the body's origin than `body_radius_m` (on the vehicle itself) are left
/// out. `pose_at` is called for each of the others, in ascending order of time. A pure function.
std::vector<PlacedReturn> placeReturns(const common::LaserScan& scan, const common::LaserConfig& laser,
                                       const PoseAt& pose_at, double body_radius_m);

}  // namespace swiftlet::perception
