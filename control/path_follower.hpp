// From a path to a smooth reference (Tomic 2012, "Action": straight lines between waypoints, flown in modes, filtered
// by the vehicle's translational dynamics). A carrot moves along the lines with a trapezoidal speed profile. A
// critically damped filter, fed with the carrot's velocity and acceleration, pulls the reference after it. The
// reference lies on the carrot on a straight line and rounds the corners. A change in flight (path, limit, frame) moves
// only the carrot; the reference stays continuous in position and velocity.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/clearance_along.hpp"
#include "common/config_fwd.hpp"
#include "common/facing.hpp"
#include "common/flight_mode.hpp"
#include "common/geometry.hpp"
#include "control/faced_path.hpp"
#include "control/path_carrot.hpp"
#include "control/reference.hpp"
#include "control/yaw_reference.hpp"

namespace swiftlet::control {

/// One thread.
class PathFollower {
 public:
  struct Limits {
    double speed_m_s = 1.0;
    double acceleration_m_s2 = 1.0;
    double corner_deviation_m = 0.05;  ///< Greatest distance of the reference from the path's lines at a corner.

    void describe(common::config::Fields& fields);
  };

  struct Config {
    Limits fast{1.0, 1.2, 0.08};
    Limits careful{0.6, 0.8, 0.05};
    Limits accurate{0.3, 0.3, 0.02};  ///< Tilts by 2 deg at most, so that a camera stays on its point.
    Limits brisk{1.2, 1.0, 0.08};
    double yaw_rate_deg_s = 60.0;

    void describe(common::config::Fields& fields);
    const Limits& limits(common::FlightMode mode) const;
  };

  explicit PathFollower(const Config& config);

  /// Places the reference at rest and discards the path.
  void reset(const Eigen::Vector3d& position_odom_m, double yaw_odom_rad);

  /// Replaces the path. The points are in odom, the last one is the goal; an empty path stops. If the reference is off
  /// the first line, it joins the nearest point of the first lines. The yaw follows the facings, which were planned
  /// along the path; without any it turns to `goal_yaw_odom_rad`, or stays. Where the smooth lines onto the path come
  /// nearer to something than the path that they leave out, by `clearance_odom_m`, the reference brakes first and takes
  /// the shortest ones.
  void setPath(std::vector<Eigen::Vector3d> points_odom_m, common::FlightMode mode,
               std::optional<double> goal_yaw_odom_rad = std::nullopt, std::vector<common::Facing> facings_odom = {},
               const common::ClearanceAlong& clearance_odom_m = {});
  /// Leaves the path and flies at that velocity and yaw until the next command. The velocity changes along a straight
  /// line by `acceleration_m_s2`, so it may reverse at once.
  void setVelocity(const Eigen::Vector3d& velocity_odom_m_s, double acceleration_m_s2, double yaw_odom_rad);
  /// Stops as fast as the mode's limits allow and holds there.
  void stop();
  /// While it is set, the yaw faces that point on paths and while holding; a velocity has a yaw of its own.
  void lookAt(const std::optional<Eigen::Vector2d>& point_odom_m) { yaw_.lookAt(point_odom_m); }
  /// Speed limit of the reactive layer: 0 halts on the path, infinity lifts the limit. It holds until it is changed.
  void setSpeedLimit(double speed_m_s);
  /// Greatest speed on the present path: 0 halts on it, infinity lifts the limit. A new path, velocity or stop lifts
  /// it.
  void setPace(double speed_m_s);
  /// Shares in (0, 1] of the mode's speed, from now on, and of the acceleration that paths are planned with, from the
  /// next path on. Braking for the reactive layer, and stopping, keep the mode's whole acceleration.
  void setShares(double speed, double acceleration);
  /// Moves the path (or the velocity) by T_new_old, after T_map_odom has jumped. The reference does not move.
  void movePath(const common::Pose2& T_new_old);

  /// Advances by dt and returns the reference at that time.
  const Reference& advance(double dt_s);
  const Reference& reference() const { return reference_; }

  /// The last path is still being followed: no stop, velocity or reset has replaced it.
  bool followsPath() const { return follows_path_; }
  /// Length of the rest of the path.
  double remaining_m() const { return carrot_.remaining_m(); }
  /// The carrot is at the goal and the reference rests there (within 1 mm and 1 mm/s).
  bool finished() const;

  /// Greatest speed in that mode, with the present share.
  double speed_m_s(common::FlightMode mode) const { return speed_share_ * config_.limits(mode).speed_m_s; }
  double acceleration_m_s2(common::FlightMode mode) const {
    return acceleration_share_ * config_.limits(mode).acceleration_m_s2;
  }
  double brakingDistance_m(common::FlightMode mode, double speed_m_s) const {
    return 0.5 * speed_m_s * speed_m_s / acceleration_m_s2(mode);
  }
  double yawRate_rad_s() const { return config_.yaw_rate_deg_s * common::kRadPerDeg; }

 private:
  const Limits& limits() const { return config_.limits(mode_); }
  double climbSpeed_m_s() const;
  /// The carrot begins at the first of the points, at rest.
  void lay(std::vector<Eigen::Vector3d> points, double acceleration_m_s2);
  /// The least of the limits of the mode, of the reactive layer, of the climb and of the planned yaws.
  double allowedSpeed_m_s() const;
  double speedForNose_m_s() const;
  void pullReference(const Carrot& carrot, double dt_s);

  Config config_;
  common::FlightMode mode_ = common::FlightMode::kCareful;
  struct Caps {
    double limit_m_s;  ///< Of the reactive layer.
    double pace_m_s;
  } caps_;
  double speed_share_ = 1.0, acceleration_share_ = 1.0;
  PathCarrot carrot_;
  FacedPath faced_;
  std::optional<VelocityCarrot> velocity_carrot_;  ///< Flown instead of the path.
  bool follows_path_ = false;  ///< The lines are a path that was set, not the braking distance of a stop.
  YawReference yaw_;
  Reference reference_;
};

}  // namespace swiftlet::control
