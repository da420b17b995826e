// The recent scans of the vehicle, in the odometry frame. Until the vehicle is localized, all of them together are
// compared with the given map, so that places which look alike from one point can be distinguished (Grzonka 2012, IV-B:
// "even when a map is known a priori, a local map is needed until the robot is localized").
#pragma once

#include <deque>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Not thread-safe.
class LocalMap {
 public:
  /// Keeps the scans of the last `length_m` metres of the path, because the odometry drifts, and at most the last 200.
  explicit LocalMap(double length_m) : length_m_(length_m) {}

  void clear() { key_scans_.clear(); }
  void add(const common::Pose2& T_odom_body, const std::vector<Eigen::Vector2f>& points_body_m);

  bool empty() const { return key_scans_.empty(); }
  /// Path length from its first scan to its last.
  double length_m() const;
  /// Pose of the last scan. Must not be called when the map is empty.
  const common::Pose2& T_odom_last() const { return key_scans_.back().T_odom_body; }

  /// The local map as one scan, in the frame of its middle scan.
  struct Whole {
    common::Pose2 T_odom_middle;
    std::vector<Eigen::Vector2f> points_middle_m;
  };
  /// At most `max_points`, evenly spread; at most one in each square of `spacing_m`. The map must not be empty.
  Whole whole(double spacing_m, std::size_t max_points) const;

 private:
  struct KeyScan {
    common::Pose2 T_odom_body;
    std::vector<Eigen::Vector2f> points_body_m;
    double path_length_m = 0.0;  ///< Path length since the first scan.
  };
  double length_m_;
  std::deque<KeyScan> key_scans_;
};

}  // namespace swiftlet::perception
