// A disc in the plane of the map: the place of a person, or a place where an attempt failed.
#pragma once

#include <Eigen/Core>

namespace swiftlet::common {

/// In the `map` frame.
struct Disc {
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;

  bool operator==(const Disc&) const = default;

  bool covers(const Eigen::Vector2d& point_map_m) const {
    return (point_map_m - center_map_m).squaredNorm() <= radius_m * radius_m;
  }
};

}  // namespace swiftlet::common
