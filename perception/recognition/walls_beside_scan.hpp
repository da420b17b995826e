// What the laser saw before and does not see now, behind the vehicle, from the map: an opening before it may be the
// mirror image of that (see mirror_check.hpp).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::perception {

/// In the frame of the laser: the nearest occupied cell of the map in each bearing, in steps of half a degree, in which
/// the scan has no beam or no valid one. Beyond the laser's range there is none.
std::vector<Eigen::Vector3d> wallsBesideScan(const common::LaserScan& scan, const common::Pose3& T_map_laser,
                                             const common::OccupancyGrid& grid);

}  // namespace swiftlet::perception
