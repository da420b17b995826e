// What the vehicle has seen lately, in the odometry's frame: as long as it is not known where it is, the whole of it is
// compared with the given map, so that places which look alike from one point are told apart (Grzonka 2012, IV-B: "even
// when a map is known a priori, a local map is needed until the robot is localized").
#pragma once

#include <deque>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Not thread-safe.
class LocalMap {
 public:
  /// Scans farther back than `length_m` of the way are forgotten: by then the odometry has drifted. So are, on the
  /// spot, all but the last 200.
  explicit LocalMap(double length_m) : length_m_(length_m) {}

  void clear() { key_scans_.clear(); }
  void add(const common::Pose2& T_odom_body, const std::vector<Eigen::Vector2f>& points_body_m);

  bool empty() const { return key_scans_.empty(); }
  /// The way from its first scan to its last.
  double length_m() const;
  /// Where its last scan was taken. Not to be called when it is empty.
  const common::Pose2& T_odom_last() const { return key_scans_.back().T_odom_body; }

  /// The local map as one scan, seen from the middle of the way.
  struct Whole {
    common::Pose2 T_odom_middle;
    std::vector<Eigen::Vector2f> points_middle_m;
  };
  /// At most `max_points`, spread evenly over what was seen: one in a square of `spacing_m`.
  Whole whole(double spacing_m, std::size_t max_points) const;

 private:
  struct KeyScan {
    common::Pose2 T_odom_body;
    std::vector<Eigen::Vector2f> points_body_m;
    double path_length_m = 0.0;  ///< Since the very first scan.
  };
  double length_m_;
  std::deque<KeyScan> key_scans_;
};

}  // namespace swiftlet::perception
