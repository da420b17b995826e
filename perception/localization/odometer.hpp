// Path length and total rotation of the odometry, without its jitter: at rest the errors of single steps would
// otherwise add up.
#pragma once

#include <cmath>
#include <optional>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Adds up chords between poses that are farther apart than the jitter of the odometry.
class Odometer {
 public:
  void add(const common::Pose2& T_odom_body) {
    if (!last_) T_odom_chord_ = T_odom_turn_ = T_odom_body;
    last_ = T_odom_body;
    const double chord_m = distance_m(T_odom_body), turn_rad = this->turn_rad(T_odom_body);
    if (chord_m >= kChord_m) {
      path_length_m_ += chord_m;
      T_odom_chord_ = T_odom_body;
    }
    if (turn_rad >= kTurn_rad) {
      turned_rad_ += turn_rad;
      T_odom_turn_ = T_odom_body;
    }
  }

  bool begun() const { return last_.has_value(); }
  /// Path length up to the last pose added, or up to `next`.
  double path_length_m() const { return last_ ? path_length_m(*last_) : 0.0; }
  double path_length_m(const common::Pose2& next) const { return path_length_m_ + distance_m(next); }
  double turned_rad() const { return last_ ? turned_rad(*last_) : 0.0; }
  double turned_rad(const common::Pose2& next) const { return turned_rad_ + turn_rad(next); }

 private:
  /// The path is measured in chords of this length and turn, so that the jitter of a hovering vehicle adds nothing.
  static constexpr double kChord_m = 0.05;
  static constexpr double kTurn_rad = 3.0 * common::kRadPerDeg;

  double distance_m(const common::Pose2& pose) const { return between(T_odom_chord_, pose).position_m().norm(); }
  double turn_rad(const common::Pose2& pose) const {
    return std::abs(common::wrapAngle(pose.yaw_rad - T_odom_turn_.yaw_rad));
  }

  std::optional<common::Pose2> last_;
  common::Pose2 T_odom_chord_, T_odom_turn_;  ///< Ends of the last chord and of the last turn.
  double path_length_m_ = 0.0, turned_rad_ = 0.0;
};

}  // namespace swiftlet::perception
