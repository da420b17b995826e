// Where the nose is to point, and the turn to it within a rate and an acceleration.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "control/reference.hpp"

namespace swiftlet::control {

/// A yaw that was planned along the path, and how fast it turns.
struct PlannedYaw {
  double yaw_odom_rad = 0.0;
  double rate_rad_s = 0.0;
};

/// The nose faces, in this order: a point, what was planned along the path, the yaw of the goal, or what it faced
/// before.
class YawReference {
 public:
  explicit YawReference(double most_deg_s) : most_deg_s_(most_deg_s) {}

  /// Ends the turn to a goal, and keeps that yaw.
  void hold(double yaw_odom_rad);
  void setGoal(std::optional<double> yaw_odom_rad) { goal_odom_rad_ = yaw_odom_rad; }
  /// While it is set, the nose faces that point.
  void lookAt(const std::optional<Eigen::Vector2d>& point_odom_m) { look_at_odom_m_ = point_odom_m; }
  /// Turns the goal, after T_map_odom has jumped.
  void turn(double yaw_rad);

  bool facesPoint() const { return look_at_odom_m_.has_value(); }
  /// `yaw_odom_rad` is that of the goal, if there is one.
  bool reached(double yaw_odom_rad) const;

  /// Turns the yaw of the reference by one tick. `looks`: the point of lookAt() counts.
  void advance(Reference& reference, const std::optional<PlannedYaw>& planned, bool looks, double dt_s);

 private:
  double most_deg_s_;
  double hold_odom_rad_ = 0.0;
  std::optional<double> goal_odom_rad_;
  std::optional<Eigen::Vector2d> look_at_odom_m_;
};

}  // namespace swiftlet::control
