#include "control/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "control/path_join.hpp"

namespace swiftlet::control {

using common::FlightMode;

namespace {

/// Greatest sudden change of the velocity vector that the reference filter is given.
constexpr double kKink_m_s = 0.12;
/// Points this close to the line between their neighbours are left out.
constexpr double kSimplifyTolerance_m = 0.01;
constexpr double kClimbSpeed_m_s = 0.5;  ///< Greatest vertical part of the speed, in every mode.
/// A nose that is this far from its planned yaw, as after it faced something else, is waited for at this speed. A laser
/// of 270 deg sees the way of the hull up to 100 deg off its nose, and planned yaws are mostly within 40 deg.
constexpr double kNoseLag_rad = 60.0 * common::kRadPerDeg, kWaits_m_s = 0.15;
/// Curves are sampled: braking for them may be this much firmer than planned.
constexpr double kFirmer = 1.2;
constexpr double kFilter_rad_s = 5.0;  ///< Bandwidth of the reference filter.
constexpr double kAtGoal_m = 1e-3;     ///< Far below the error of control: only ends the reference.
constexpr double kAtRest_m_s = 1e-3;   ///< A reference this slow has stopped.

}  // namespace

PathFollower::PathFollower(const Config& config)
    : config_(config),
      caps_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
      yaw_(config.yaw_rate_deg_s) {
  reset(Eigen::Vector3d::Zero(), 0.0);
}

void PathFollower::reset(const Eigen::Vector3d& position_odom_m, double yaw_odom_rad) {
  reference_ = {};
  reference_.position_odom_m = position_odom_m;
  reference_.yaw_odom_rad = yaw_odom_rad;
  yaw_.hold(yaw_odom_rad);
  lay({position_odom_m}, limits().acceleration_m_s2);
}

double PathFollower::climbSpeed_m_s() const { return speed_share_ * kClimbSpeed_m_s; }

void PathFollower::lay(std::vector<Eigen::Vector3d> points, double acceleration_m_s2) {
  carrot_.lay(std::move(points), {limits().speed_m_s, acceleration_m_s2, climbSpeed_m_s(), kKink_m_s},
              kFirmer * limits().acceleration_m_s2);
  follows_path_ = false;
  faced_.lay({});
  caps_.pace_m_s = std::numeric_limits<double>::infinity();
  velocity_carrot_.reset();
}

void PathFollower::setPath(std::vector<Eigen::Vector3d> points, FlightMode mode,
                           std::optional<double> goal_yaw_odom_rad, std::vector<common::Facing> facings_odom,
                           const common::ClearanceAlong& clearance_odom_m) {
  mode_ = mode;
  if (points.empty()) {
    stop();
    return;
  }
  const JoinStart from{reference_.position_odom_m, reference_.velocity_odom_m_s, limits().acceleration_m_s2,
                       limits().corner_deviation_m, kKink_m_s};
  lay(joined(simplified(points, kSimplifyTolerance_m), from, clearance_odom_m),
      acceleration_share_ * limits().acceleration_m_s2);
  follows_path_ = true;
  carrot_.setSpeed(std::max(0.0, reference_.velocity_odom_m_s.dot(carrot_.line_m().normalized())));
  faced_.lay(std::move(facings_odom));
  yaw_.setGoal(goal_yaw_odom_rad);
}

void PathFollower::setVelocity(const Eigen::Vector3d& velocity_odom_m_s, double acceleration_m_s2,
                               double yaw_odom_rad) {
  if (!velocity_carrot_) {
    lay({reference_.position_odom_m}, limits().acceleration_m_s2);
    velocity_carrot_.emplace(Carrot{reference_.position_odom_m, reference_.velocity_odom_m_s, Eigen::Vector3d::Zero()});
  }
  velocity_carrot_->setTarget(velocity_odom_m_s, acceleration_m_s2);
  yaw_.setGoal(yaw_odom_rad);
}

void PathFollower::stop() {
  const Eigen::Vector3d& velocity = reference_.velocity_odom_m_s;
  const double speed = velocity.norm();
  const bool moves = speed > kAtRest_m_s;
  std::vector<Eigen::Vector3d> points{reference_.position_odom_m};
  if (moves) points.push_back(reference_.position_odom_m + velocity * (0.5 * speed / limits().acceleration_m_s2));
  lay(std::move(points), limits().acceleration_m_s2);
  if (moves) carrot_.setSpeed(speed);
  yaw_.hold(reference_.yaw_odom_rad);
}

void PathFollower::setSpeedLimit(double speed_m_s) {
  caps_.limit_m_s = std::isnan(speed_m_s) ? 0.0 : std::max(0.0, speed_m_s);
}

void PathFollower::setPace(double speed_m_s) {
  caps_.pace_m_s = std::isnan(speed_m_s) ? 0.0 : std::max(0.0, speed_m_s);
}

void PathFollower::setShares(double speed, double acceleration) {
  speed_share_ = speed;
  acceleration_share_ = acceleration;
}

void PathFollower::movePath(const common::Pose2& T_new_old) {
  carrot_.move(T_new_old);
  faced_.move(T_new_old);
  yaw_.turn(T_new_old.yaw_rad);
  if (velocity_carrot_) velocity_carrot_->turn(T_new_old.yaw_rad);
}

const Reference& PathFollower::advance(double dt_s) {
  const Carrot carrot = velocity_carrot_ ? velocity_carrot_->advance(dt_s) : carrot_.advance(dt_s, allowedSpeed_m_s());
  pullReference(carrot, dt_s);
  std::optional<PlannedYaw> planned;
  if (!faced_.empty()) {
    faced_.advance(carrot.position_odom_m.head<2>());
    planned = {faced_.yawAhead_rad(), faced_.turnAhead_rad_m() * carrot.velocity_odom_m_s.head<2>().norm()};
  }
  yaw_.advance(reference_, planned, !velocity_carrot_, dt_s);
  return reference_;
}

double PathFollower::allowedSpeed_m_s() const {
  double speed_m_s = std::min({speed_share_ * limits().speed_m_s, caps_.limit_m_s, caps_.pace_m_s});
  const Eigen::Vector3d line_m = carrot_.line_m();
  const double length_m = line_m.norm();
  if (std::abs(line_m.z()) > 1e-6) speed_m_s = std::min(speed_m_s, climbSpeed_m_s() * length_m / std::abs(line_m.z()));
  const bool climbs = line_m.head<2>().norm() <= 0.5 * length_m;
  return climbs ? speed_m_s : std::min(speed_m_s, speedForNose_m_s());
}

double PathFollower::speedForNose_m_s() const {
  if (faced_.empty() || yaw_.facesPoint()) return std::numeric_limits<double>::infinity();
  // The nose may lead by a stretch.
  const double yaw_rad = reference_.yaw_odom_rad;
  const double lag_rad = std::min(std::abs(common::wrapAngle(faced_.yaw_rad() - yaw_rad)),
                                  std::abs(common::wrapAngle(faced_.yawAhead_rad() - yaw_rad)));
  const double planned_m_s = faced_.allowedSpeed_m_s(acceleration_m_s2(mode_), {yaw_rad, yawRate_rad_s()});
  return lag_rad > kNoseLag_rad ? std::min(planned_m_s, kWaits_m_s) : planned_m_s;
}

void PathFollower::pullReference(const Carrot& carrot, double dt_s) {
  const double w = kFilter_rad_s;
  // x'' = c'' + 2 w (c' - x') + w^2 (c - x): critically damped, with no lag behind a carrot on a straight line. The
  // error decays exactly as (e0 + (e0' + w e0) t) exp(-w t).
  const Eigen::Vector3d carrot_before =
      carrot.position_odom_m - carrot.velocity_odom_m_s * dt_s + 0.5 * dt_s * dt_s * carrot.acceleration_odom_m_s2;
  const Eigen::Vector3d velocity_before = carrot.velocity_odom_m_s - carrot.acceleration_odom_m_s2 * dt_s;
  const Eigen::Vector3d error = reference_.position_odom_m - carrot_before;
  const Eigen::Vector3d error_rate = reference_.velocity_odom_m_s - velocity_before;
  const Eigen::Vector3d slope = error_rate + w * error;
  const double decay = std::exp(-w * dt_s);
  const Eigen::Vector3d error_now = decay * (error + dt_s * slope);
  const Eigen::Vector3d error_rate_now = decay * (slope - w * (error + dt_s * slope));
  reference_.position_odom_m = carrot.position_odom_m + error_now;
  reference_.velocity_odom_m_s = carrot.velocity_odom_m_s + error_rate_now;
  reference_.acceleration_odom_m_s2 = carrot.acceleration_odom_m_s2 - 2.0 * w * error_rate_now - w * w * error_now;
}

bool PathFollower::finished() const {
  return !velocity_carrot_ && remaining_m() <= 0.0 &&
         (reference_.position_odom_m - carrot_.goal()).norm() <= kAtGoal_m &&
         reference_.velocity_odom_m_s.norm() <= kAtRest_m_s && yaw_.reached(reference_.yaw_odom_rad);
}

const PathFollower::Limits& PathFollower::Config::limits(FlightMode mode) const {
  switch (mode) {
    case FlightMode::kFast:
      return fast;
    case FlightMode::kCareful:
      return careful;
    case FlightMode::kAccurate:
      return accurate;
    case FlightMode::kBrisk:
      return brisk;
  }
  SWIFTLET_CHECK(false, static_cast<int>(mode));
  return careful;
}

void PathFollower::Limits::describe(common::config::Fields& fields) {
  fields("speed_m_s", speed_m_s, {0.01, 20}, "Greatest speed.");
  fields("acceleration_m_s2", acceleration_m_s2, {0.05, 10}, "Greatest acceleration along the path and across it.");
}

void PathFollower::Config::describe(common::config::Fields& fields) {
  fields.section("fast", fast, "Limits of flight mode fast.");
  fields.section("careful", careful, "Limits of flight mode careful.");
  fields.section("accurate", accurate, "Limits of flight mode accurate.");
  fields.section("brisk", brisk, "Limits of flight mode brisk, which no behaviour uses unless the mission names it.");
  fields("yaw_rate_deg_s", yaw_rate_deg_s, {1, 360}, "Greatest yaw rate.");
}

}  // namespace swiftlet::control
