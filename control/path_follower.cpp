#include "control/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "control/path_shape.hpp"

namespace swiftlet::control {

using common::FlightMode;

namespace {

/// Greatest sudden change of the velocity vector that the reference filter is given.
constexpr double kKink_m_s = 0.12;
/// Greatest distance of the reference from a new path. Beyond it, an extra line leads the reference to the path.
constexpr double kOnPath_m = 0.03;
/// The reference joins a new path within its first stretch of this length.
constexpr double kJoin_m = 1.5;
constexpr double kAtGoal_m = 1e-3;        ///< Far below the error of control: only ends the reference.
constexpr double kAtRest_m_s = 1e-3;      ///< A reference this slow has stopped.
constexpr double kYawReached_rad = 0.01;  ///< Half a degree, below the error of a hover, 1 deg.
/// A shorter look-ahead gives no reliable direction.
constexpr double kLeastLook_m = 0.05;

}  // namespace

PathFollower::PathFollower(const Config& config)
    : config_(config),
      limits_(config.careful),
      speed_limit_m_s_(std::numeric_limits<double>::infinity()),
      pace_m_s_(std::numeric_limits<double>::infinity()),
      laid_acceleration_m_s2_(limits_.acceleration_m_s2) {
  reset(Eigen::Vector3d::Zero(), 0.0);
}

void PathFollower::reset(const Eigen::Vector3d& position_odom_m, double yaw_odom_rad) {
  reference_ = {};
  reference_.position_odom_m = position_odom_m;
  reference_.yaw_odom_rad = hold_yaw_odom_rad_ = yaw_odom_rad;
  goal_yaw_odom_rad_.reset();
  faces_travel_ = false;
  lay({position_odom_m}, limits_.acceleration_m_s2);
  carrot_speed_m_s_ = 0.0;
}

void PathFollower::lay(std::vector<Eigen::Vector3d> points, double acceleration_m_s2) {
  points_ = std::move(points);
  laid_acceleration_m_s2_ = acceleration_m_s2;
  distances_m_ = distancesAlong(points_);
  speeds_m_s_ = speedsAlong(points_, {limits_.speed_m_s, acceleration_m_s2, climbSpeed_m_s(), kKink_m_s});
  carrot_m_ = 0.0;
  follows_path_ = false;
  pace_m_s_ = std::numeric_limits<double>::infinity();
  velocity_target_.reset();
}

void PathFollower::setPath(std::vector<Eigen::Vector3d> points, FlightMode mode,
                           std::optional<double> goal_yaw_odom_rad) {
  limits_ = config_.limits(mode);
  if (points.empty()) {
    stop();
    return;
  }
  points = simplified(points, config_.simplify_tolerance_m);
  bool turns = false;
  points = joined(points, turns);
  lay(rounded(points, limits_.corner_deviation_m, turns), acceleration_share_ * limits_.acceleration_m_s2);
  follows_path_ = true;
  carrot_speed_m_s_ = 0.0;
  if (points_.size() > 1) {
    const Eigen::Vector3d direction = (points_[1] - points_[0]).normalized();
    carrot_speed_m_s_ = std::max(0.0, reference_.velocity_odom_m_s.dot(direction));
  }
  goal_yaw_odom_rad_ = goal_yaw_odom_rad;
  faces_travel_ = remaining_m() > config_.turn_distance_m;
}

std::vector<Eigen::Vector3d> PathFollower::joined(const std::vector<Eigen::Vector3d>& points, bool& turns) const {
  const std::vector<double> along = distancesAlong(points);
  const auto rest = [&](double from_m) {
    std::vector<Eigen::Vector3d> out{pointOn(points, along, from_m)};
    for (std::size_t i = 0; i < points.size(); ++i)
      if (along[i] > from_m + 1e-6) out.push_back(points[i]);
    return out;
  };
  const Eigen::Vector3d& here = reference_.position_odom_m;
  const Eigen::Vector3d& velocity = reference_.velocity_odom_m_s;
  const auto [near_m, off_m] = nearestOn(points, along, here, kJoin_m);

  std::vector<Eigen::Vector3d> out = rest(near_m);
  // Within reach of the reference filter: the carrot starts on the path itself.
  const Eigen::Vector3d direction =
      out.size() > 1 ? Eigen::Vector3d((out[1] - out[0]).normalized()) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d across = velocity - std::max(0.0, velocity.dot(direction)) * direction;
  if (off_m <= kOnPath_m && across.norm() <= 2.0 * kKink_m_s) return out;

  if (velocity.norm() <= 2.0 * kKink_m_s) {  // Slow: fly straight to a point as far ahead as the distance off the path.
    out = rest(std::min(near_m + off_m, along.back()));
    out.insert(out.begin(), here);
    return out;
  }
  // Fast in another direction: continue along the velocity for as long as turning (or stopping) takes, then join the
  // path.
  const double speed = velocity.norm();
  const Eigen::Vector3d heading = velocity / speed;
  const Eigen::Vector3d target = pointOn(points, along, std::min(near_m + std::max(off_m, 0.3), along.back()));
  const double cosine = std::clamp(heading.dot((target - here).normalized()), -1.0, 1.0);
  const double stop_m = 0.5 * speed * speed / limits_.acceleration_m_s2;
  const double turn_m = 2.0 * stop_m * std::sqrt((1.0 - cosine) / std::max(1e-6, 1.0 + cosine));
  const Eigen::Vector3d corner = here + std::min(stop_m, turn_m) * heading;
  const auto [corner_m, corner_off_m] = nearestOn(points, along, corner, kJoin_m);
  out = rest(std::min(corner_m + std::max(corner_off_m, std::min(stop_m, turn_m)), along.back()));
  out.insert(out.begin(), {here, corner});
  turns = true;
  return out;
}

void PathFollower::setVelocity(const Eigen::Vector3d& velocity_odom_m_s, double acceleration_m_s2,
                               double yaw_odom_rad) {
  if (!velocity_target_) {
    lay({reference_.position_odom_m}, limits_.acceleration_m_s2);
    carrot_speed_m_s_ = 0.0;
    velocity_target_ =
        VelocityTarget{{}, 0.0, {reference_.position_odom_m, reference_.velocity_odom_m_s, Eigen::Vector3d::Zero()}};
  }
  velocity_target_->velocity_odom_m_s = velocity_odom_m_s;
  velocity_target_->acceleration_m_s2 = acceleration_m_s2;
  goal_yaw_odom_rad_ = yaw_odom_rad;
  faces_travel_ = false;
}

void PathFollower::stop() {
  const Eigen::Vector3d& velocity = reference_.velocity_odom_m_s;
  const double speed = velocity.norm();
  std::vector<Eigen::Vector3d> points{reference_.position_odom_m};
  if (speed > kAtRest_m_s)
    points.push_back(reference_.position_odom_m + velocity * (0.5 * speed / limits_.acceleration_m_s2));
  lay(std::move(points), limits_.acceleration_m_s2);
  carrot_speed_m_s_ = points_.size() > 1 ? speed : 0.0;
  goal_yaw_odom_rad_.reset();
  faces_travel_ = false;
  hold_yaw_odom_rad_ = reference_.yaw_odom_rad;
}

void PathFollower::setSpeedLimit(double speed_m_s) {
  speed_limit_m_s_ = std::isnan(speed_m_s) ? 0.0 : std::max(0.0, speed_m_s);
}

void PathFollower::setPace(double speed_m_s) { pace_m_s_ = std::isnan(speed_m_s) ? 0.0 : std::max(0.0, speed_m_s); }

void PathFollower::setShares(double speed, double acceleration) {
  speed_share_ = speed;
  acceleration_share_ = acceleration;
}

void PathFollower::movePath(const common::Pose2& T_new_old) {
  for (Eigen::Vector3d& point : points_) point.head<2>() = T_new_old * Eigen::Vector2d(point.head<2>());
  if (goal_yaw_odom_rad_) *goal_yaw_odom_rad_ += T_new_old.yaw_rad;
  if (velocity_target_) {
    const Eigen::Rotation2Dd turn(T_new_old.yaw_rad);
    velocity_target_->velocity_odom_m_s.head<2>() =
        turn * Eigen::Vector2d(velocity_target_->velocity_odom_m_s.head<2>());
  }
}

const Reference& PathFollower::advance(double dt_s) {
  pullReference(velocity_target_ ? advanceToVelocity(*velocity_target_, dt_s) : advanceAlongPath(dt_s), dt_s);
  advanceYaw(dt_s);
  return reference_;
}

PathFollower::Carrot PathFollower::advanceToVelocity(VelocityTarget& target, double dt_s) {
  Carrot& carrot = target.carrot;
  const Eigen::Vector3d before = carrot.velocity_odom_m_s;
  const Eigen::Vector3d change = target.velocity_odom_m_s - before;
  const double most = target.acceleration_m_s2 * dt_s;
  carrot.velocity_odom_m_s += change.norm() > most ? Eigen::Vector3d(change.normalized() * most) : change;
  carrot.position_odom_m += 0.5 * (before + carrot.velocity_odom_m_s) * dt_s;
  carrot.acceleration_odom_m_s2 = (carrot.velocity_odom_m_s - before) / dt_s;
  return carrot;
}

PathFollower::Carrot PathFollower::advanceAlongPath(double dt_s) {
  const double before = carrot_speed_m_s_, most = 1.2 * limits_.acceleration_m_s2;
  // Curves are sampled: braking for them may be a little firmer than planned.
  carrot_speed_m_s_ =
      std::clamp(allowedSpeed(dt_s), std::max(0.0, before - most * dt_s), before + laid_acceleration_m_s2_ * dt_s);
  carrot_m_ += 0.5 * (before + carrot_speed_m_s_) * dt_s;
  const double end_m = distances_m_.back();
  if (carrot_m_ >= end_m - 1e-5) {
    carrot_m_ = end_m;
    carrot_speed_m_s_ = 0.0;
  }
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  if (points_.size() > 1) {
    const std::size_t segment = segmentAt(carrot_m_);
    direction = (points_[segment + 1] - points_[segment]).normalized();
  }
  return {pointOn(points_, distances_m_, carrot_m_), carrot_speed_m_s_ * direction,
          std::clamp((carrot_speed_m_s_ - before) / dt_s, -most, most) * direction};
}

double PathFollower::allowedSpeed(double dt_s) const {
  double speed = std::min({speed_share_ * limits_.speed_m_s, speed_limit_m_s_, pace_m_s_});
  if (points_.size() < 2) return 0.0;
  const std::size_t segment = segmentAt(carrot_m_);
  const double to_next_m = distances_m_[segment + 1] - carrot_m_;
  const double next = speeds_m_s_[segment + 1];
  // v^2 = next^2 + 2 a (distance left after this step), solved for the speed at the end of the step, so that braking
  // never needs more than a.
  const double a = laid_acceleration_m_s2_, half = 0.5 * a * dt_s;
  const double left2 = next * next + 2.0 * a * std::max(0.0, to_next_m) - a * dt_s * carrot_speed_m_s_;
  speed = std::min(speed, std::max(0.0, std::sqrt(std::max(0.0, half * half + left2)) - half));
  const Eigen::Vector3d along = points_[segment + 1] - points_[segment];
  const double length_m = along.norm();
  if (std::abs(along.z()) > 1e-6) speed = std::min(speed, climbSpeed_m_s() * length_m / std::abs(along.z()));
  const double planar_m = along.head<2>().norm();
  if (faces_travel_ && !look_at_odom_m_ && planar_m > 0.5 * length_m) {
    const double off_nose = common::wrapAngle(std::atan2(along.y(), along.x()) - reference_.yaw_odom_rad);
    if (std::abs(off_nose) > config_.turn_first_angle_deg * common::kRadPerDeg)
      speed = std::min(speed, config_.turn_first_speed_m_s);
  }
  return speed;
}

void PathFollower::pullReference(const Carrot& carrot, double dt_s) {
  const double w = config_.filter_rad_s;
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

void PathFollower::advanceYaw(double dt_s) {
  double wanted_rad = hold_yaw_odom_rad_;
  double turns_rad_s = 0.0;  // The rate of the bearing of a point that the vehicle flies past.
  const double left_m = remaining_m();
  if (look_at_odom_m_ && !velocity_target_) {
    const Eigen::Vector2d look = *look_at_odom_m_ - reference_.position_odom_m.head<2>();
    if (look.norm() > kLeastLook_m) {
      hold_yaw_odom_rad_ = wanted_rad = std::atan2(look.y(), look.x());
      const Eigen::Vector3d& velocity = reference_.velocity_odom_m_s;
      turns_rad_s = (look.y() * velocity.x() - look.x() * velocity.y()) / look.squaredNorm();
    }
  } else if (faces_travel_ && left_m > config_.turn_distance_m) {
    const Eigen::Vector3d ahead = pointOn(points_, distances_m_, carrot_m_ + config_.look_ahead_m);
    const Eigen::Vector2d look = (ahead - reference_.position_odom_m).head<2>();
    if (look.norm() > kLeastLook_m) hold_yaw_odom_rad_ = wanted_rad = std::atan2(look.y(), look.x());
  } else if (goal_yaw_odom_rad_) {
    hold_yaw_odom_rad_ = wanted_rad = *goal_yaw_odom_rad_;
  }
  const double error = common::wrapAngle(wanted_rad - reference_.yaw_odom_rad);
  const double most_rad_s = config_.yaw_rate_deg_s * common::kRadPerDeg;
  const double step = config_.yaw_acceleration_deg_s2 * common::kRadPerDeg * dt_s;
  const double stoppable = std::sqrt(2.0 * config_.yaw_acceleration_deg_s2 * common::kRadPerDeg * std::abs(error));
  // The last step ends on the goal, so that the carrot does not oscillate about it.
  const double rate = std::min({most_rad_s, stoppable, std::abs(error) / dt_s});
  const double wanted_rad_s = std::clamp(turns_rad_s + std::copysign(rate, error), -most_rad_s, most_rad_s);
  reference_.yaw_rate_rad_s =
      std::clamp(wanted_rad_s, reference_.yaw_rate_rad_s - 1.2 * step, reference_.yaw_rate_rad_s + 1.2 * step);
  reference_.yaw_odom_rad = common::wrapAngle(reference_.yaw_odom_rad + reference_.yaw_rate_rad_s * dt_s);
}

double PathFollower::remaining_m() const { return distances_m_.back() - carrot_m_; }

bool PathFollower::finished() const {
  const bool there = !velocity_target_ && remaining_m() <= 0.0 &&
                     (reference_.position_odom_m - points_.back()).norm() <= kAtGoal_m &&
                     reference_.velocity_odom_m_s.norm() <= kAtRest_m_s;
  return there && (!goal_yaw_odom_rad_ ||
                   std::abs(common::wrapAngle(*goal_yaw_odom_rad_ - reference_.yaw_odom_rad)) <= kYawReached_rad);
}

std::size_t PathFollower::segmentAt(double distance_m) const {
  const auto after = std::upper_bound(distances_m_.begin() + 1, distances_m_.end() - 1, distance_m);
  return static_cast<std::size_t>(after - distances_m_.begin()) - 1;
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
