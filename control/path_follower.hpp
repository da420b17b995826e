// From a path to a smooth reference (Tomic 2012, "Action": straight lines between waypoints, flown in modes, filtered
// by the vehicle's translational dynamics). A carrot moves along the lines with a trapezoidal speed profile. A
// critically damped filter, fed with the carrot's velocity and acceleration, pulls the reference after it. The
// reference lies on the carrot on a straight line and rounds the corners. A change in flight (path, limit, frame) moves
// only the carrot; the reference stays continuous in position and velocity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/flight_mode.hpp"
#include "common/geometry.hpp"
#include "control/reference.hpp"

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
    static constexpr double climb_speed_m_s = 0.5;  ///< Greatest vertical part of the speed, in every mode.
    static constexpr double filter_rad_s = 5.0;     ///< Bandwidth of the reference filter.
    static constexpr double simplify_tolerance_m =
        0.01;  ///< Points this close to the line between their neighbours are left out.
    static constexpr double turn_distance_m =
        0.6;  ///< Goals farther than this are faced; nearer ones are flown to sideways.
    double yaw_rate_deg_s = 60.0;
    static constexpr double yaw_acceleration_deg_s2 = 180.0;  ///< Greatest yaw acceleration.
    static constexpr double look_ahead_m = 0.5;               ///< The yaw faces the path this far ahead.
    static constexpr double turn_first_angle_deg =
        100.0;  ///< Where the path leads this far off the nose, which the laser does not see, the vehicle turns first.
    static constexpr double turn_first_speed_m_s = 0.15;  ///< Greatest speed while turning first.

    void describe(common::config::Fields& fields);
    const Limits& limits(common::FlightMode mode) const;
  };

  explicit PathFollower(const Config& config);

  /// Places the reference at rest and discards the path.
  void reset(const Eigen::Vector3d& position_odom_m, double yaw_odom_rad);

  /// Replaces the path. The points are in odom, the last one is the goal; an empty path stops. If the reference is off
  /// the first line, it joins the nearest point of the first lines. Near the goal it turns to `goal_yaw_odom_rad`.
  void setPath(std::vector<Eigen::Vector3d> points_odom_m, common::FlightMode mode,
               std::optional<double> goal_yaw_odom_rad = std::nullopt);
  /// Leaves the path and flies at that velocity and yaw until the next command. The velocity changes along a straight
  /// line by `acceleration_m_s2`, so it may reverse at once.
  void setVelocity(const Eigen::Vector3d& velocity_odom_m_s, double acceleration_m_s2, double yaw_odom_rad);
  /// Stops as fast as the mode's limits allow and holds there.
  void stop();
  /// While it is set, the yaw faces that point on paths and while holding; a velocity has a yaw of its own.
  void lookAt(const std::optional<Eigen::Vector2d>& point_odom_m) { look_at_odom_m_ = point_odom_m; }
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
  double remaining_m() const;
  /// The carrot is at the goal and the reference rests there (within 1 mm and 1 mm/s).
  bool finished() const;

 private:
  /// The point that the reference is pulled after.
  struct Carrot {
    Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration_odom_m_s2 = Eigen::Vector3d::Zero();
  };
  /// The velocity that is flown instead of a path.
  struct VelocityTarget {
    Eigen::Vector3d velocity_odom_m_s;
    double acceleration_m_s2;
    Carrot carrot;
  };

  void lay(std::vector<Eigen::Vector3d> points, double acceleration_m_s2);
  double climbSpeed_m_s() const { return speed_share_ * config_.climb_speed_m_s; }
  /// The path, joined to the reference's present position and velocity. `turns` is set if its first corner is flown at
  /// speed.
  std::vector<Eigen::Vector3d> joined(const std::vector<Eigen::Vector3d>& points, bool& turns) const;
  Carrot advanceAlongPath(double dt_s);
  static Carrot advanceToVelocity(VelocityTarget& target, double dt_s);
  void pullReference(const Carrot& carrot, double dt_s);
  void advanceYaw(double dt_s);
  double allowedSpeed(double dt_s) const;
  std::size_t segmentAt(double distance_m) const;

  Config config_;
  Limits limits_;
  double speed_limit_m_s_;
  double pace_m_s_;
  double speed_share_ = 1.0, acceleration_share_ = 1.0;
  double laid_acceleration_m_s2_;  ///< With which the present lines are flown.
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> distances_m_;  ///< Distance of each point along the path.
  std::vector<double> speeds_m_s_;   ///< Greatest speed at each point at which all later ones can still be met.
  std::optional<double> goal_yaw_odom_rad_;
  double carrot_m_ = 0.0;
  double carrot_speed_m_s_ = 0.0;
  bool follows_path_ = false;  ///< The lines are a path that was set, not the braking distance of a stop.
  std::optional<VelocityTarget> velocity_target_;
  double hold_yaw_odom_rad_ = 0.0;
  bool faces_travel_ = false;
  std::optional<Eigen::Vector2d> look_at_odom_m_;
  Reference reference_;
};

}  // namespace swiftlet::control
