// A drive through a floor: what the laser saw, what the wheels said, and where the robot was.
#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/floors/floor_plan.hpp"
#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/trajectory.hpp"

namespace swiftlet::benchmarks {

struct DrivenScan {
  common::LaserScan scan;
  common::Pose2 T_odom_robot;
};

struct FloorDrive {
  std::vector<DrivenScan> scans;
  common::Trajectory truth;  ///< Of the robot, with the stamps of the scans.
};

/// The laser has 180 beams over 180 degrees, 81 m of range and 1.2 cm of noise; 2 beams in 1,000 find nothing. A scan
/// every 12 cm. The wheels have a constant error of up to some percent, and drift. Equal seeds give equal drives.
FloorDrive makeFloorDrive(const FloorPlan& plan, std::uint64_t seed);

}  // namespace swiftlet::benchmarks
