// The point that the reference is pulled after: on the lines of a path, or at a velocity.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "control/path_shape.hpp"

namespace swiftlet::control {

struct Carrot {
  Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_odom_m_s2 = Eigen::Vector3d::Zero();
};

/// Moves along straight lines with a trapezoidal speed profile. lay() first.
class PathCarrot {
 public:
  /// Begins at rest at the first of the points, of which there is at least one. `braking_m_s2`: greatest deceleration,
  /// for a speed limit that falls in flight.
  void lay(Points points, const SpeedLimits& limits, double braking_m_s2);
  /// The speed with which the carrot goes on.
  void setSpeed(double speed_m_s) { speed_m_s_ = speed_m_s; }
  /// Moves the lines by T_new_old in the plane, and the carrot with them.
  void move(const common::Pose2& T_new_old);

  /// Advances by dt, not faster than `cap_m_s` where it can brake in time.
  Carrot advance(double dt_s, double cap_m_s);

  /// The present line, from its start to its end; zero if there is only one point.
  Eigen::Vector3d line_m() const;
  /// The point so far ahead of the carrot, or the goal.
  Eigen::Vector3d pointAhead(double ahead_m) const { return pointOn(points_, distances_m_, at_m_ + ahead_m); }
  const Eigen::Vector3d& goal() const { return points_.back(); }
  double remaining_m() const { return distances_m_.back() - at_m_; }

 private:
  /// The speed at which the next point's speed, and the goal, can still be met after a step.
  double stoppableSpeed_m_s(double dt_s) const;
  std::size_t lineAt(double distance_m) const;

  Points points_;
  std::vector<double> distances_m_;  ///< Distance of each point along the path.
  std::vector<double> speeds_m_s_;   ///< Greatest speed at each point at which all later ones can still be met.
  double acceleration_m_s2_ = 0.0;   ///< With which the lines are flown.
  double braking_m_s2_ = 0.0;
  double at_m_ = 0.0;
  double speed_m_s_ = 0.0;
};

/// Changes its velocity along a straight line to a wanted one.
class VelocityCarrot {
 public:
  explicit VelocityCarrot(const Carrot& start) : carrot_(start) {}

  void setTarget(const Eigen::Vector3d& velocity_odom_m_s, double acceleration_m_s2);
  /// Turns the wanted velocity, after T_map_odom has jumped.
  void turn(double yaw_rad);
  const Carrot& advance(double dt_s);

 private:
  Eigen::Vector3d target_odom_m_s_ = Eigen::Vector3d::Zero();
  double acceleration_m_s2_ = 0.0;
  Carrot carrot_;
};

}  // namespace swiftlet::control
