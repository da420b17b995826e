#include "control/path_carrot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::control {

void PathCarrot::lay(Points points, const SpeedLimits& limits, double braking_m_s2) {
  points_ = std::move(points);
  acceleration_m_s2_ = limits.acceleration_m_s2;
  braking_m_s2_ = braking_m_s2;
  distances_m_ = distancesAlong(points_);
  speeds_m_s_ = speedsAlong(points_, limits);
  at_m_ = speed_m_s_ = 0.0;
}

void PathCarrot::move(const common::Pose2& T_new_old) {
  for (Eigen::Vector3d& point : points_) point.head<2>() = T_new_old * Eigen::Vector2d(point.head<2>());
}

Carrot PathCarrot::advance(double dt_s, double cap_m_s) {
  const double before = speed_m_s_;
  const double allowed = points_.size() < 2 ? 0.0 : std::min(cap_m_s, stoppableSpeed_m_s(dt_s));
  speed_m_s_ = std::clamp(allowed, std::max(0.0, before - braking_m_s2_ * dt_s), before + acceleration_m_s2_ * dt_s);
  at_m_ += 0.5 * (before + speed_m_s_) * dt_s;
  constexpr double kAtEnd_m = 1e-5;  // A braking profile only approaches its end.
  const double end_m = distances_m_.back();
  if (at_m_ >= end_m - kAtEnd_m) {
    at_m_ = end_m;
    speed_m_s_ = 0.0;
  }
  const Eigen::Vector3d line_m = this->line_m();
  const Eigen::Vector3d direction = points_.size() > 1 ? Eigen::Vector3d(line_m.normalized()) : line_m;
  return {pointOn(points_, distances_m_, at_m_), speed_m_s_ * direction,
          std::clamp((speed_m_s_ - before) / dt_s, -braking_m_s2_, braking_m_s2_) * direction};
}

double PathCarrot::stoppableSpeed_m_s(double dt_s) const {
  const std::size_t line = lineAt(at_m_);
  const double to_next_m = distances_m_[line + 1] - at_m_;
  const double next = speeds_m_s_[line + 1];
  // v^2 = next^2 + 2 a (distance left after this step), solved for the speed at the end of the step, so that braking
  // never needs more than a.
  const double a = acceleration_m_s2_, half = 0.5 * a * dt_s;
  const double left2 = next * next + 2.0 * a * std::max(0.0, to_next_m) - a * dt_s * speed_m_s_;
  return std::max(0.0, std::sqrt(std::max(0.0, half * half + left2)) - half);
}

Eigen::Vector3d PathCarrot::line_m() const {
  if (points_.size() < 2) return Eigen::Vector3d::Zero();
  const std::size_t line = lineAt(at_m_);
  return points_[line + 1] - points_[line];
}

std::size_t PathCarrot::lineAt(double distance_m) const {
  const auto after = std::upper_bound(distances_m_.begin() + 1, distances_m_.end() - 1, distance_m);
  return static_cast<std::size_t>(after - distances_m_.begin()) - 1;
}

void VelocityCarrot::setTarget(const Eigen::Vector3d& velocity_odom_m_s, double acceleration_m_s2) {
  target_odom_m_s_ = velocity_odom_m_s;
  acceleration_m_s2_ = acceleration_m_s2;
}

void VelocityCarrot::turn(double yaw_rad) {
  target_odom_m_s_.head<2>() = Eigen::Rotation2Dd(yaw_rad) * Eigen::Vector2d(target_odom_m_s_.head<2>());
}

const Carrot& VelocityCarrot::advance(double dt_s) {
  const Eigen::Vector3d before = carrot_.velocity_odom_m_s;
  const Eigen::Vector3d change = target_odom_m_s_ - before;
  const double most = acceleration_m_s2_ * dt_s;
  carrot_.velocity_odom_m_s += change.norm() > most ? Eigen::Vector3d(change.normalized() * most) : change;
  carrot_.position_odom_m += 0.5 * (before + carrot_.velocity_odom_m_s) * dt_s;
  carrot_.acceleration_odom_m_s2 = (carrot_.velocity_odom_m_s - before) / dt_s;
  return carrot_;
}

}  // namespace swiftlet::control
