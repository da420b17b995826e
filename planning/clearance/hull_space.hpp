// Where an upright hull may fly at any height, as a plan in space is made and judged.
#pragma once

#include <Eigen/Core>

#include "planning/clearance/clearance.hpp"

namespace swiftlet::planning {

/// A value that is cheap to copy. Places are those of the body, in `map`; z is over the take-off floor.
struct HullSpace {
  Clearance clearance;    ///< Of a cylinder: the hull with the air that it needs above and below.
  double middle_m = 0.0;  ///< Height of that cylinder's middle over the body's place; negative below.
  double radius_m = 0.0;  ///< Of the hull, with the least that it keeps clear.

  Eigen::Vector3d middleOf(const Eigen::Vector3d& place_map_m) const {
    return place_map_m + middle_m * Eigen::Vector3d::UnitZ();
  }
  bool isFree(const Eigen::Vector3d& place_map_m) const { return clearance.at_m(middleOf(place_map_m)) >= radius_m; }
  bool isFree(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m) const {
    return clearance.isFree(middleOf(from_map_m), middleOf(to_map_m), radius_m);
  }
};

}  // namespace swiftlet::planning
