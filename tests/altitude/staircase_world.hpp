// Boxes on a floor, measured from above by mirror beams, to test the multilevel filter.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "common/random.hpp"
#include "perception/altitude/multilevel_filter.hpp"

namespace swiftlet::perception {

struct Box {
  double x0, x1, y0, y1, height_m;
  double height_at_x1_m = -1.0;  ///< Height at x1. If it differs, the top is a slope.
  double heightAt(double x) const {
    return height_at_x1_m < 0.0 ? height_m : height_m + (height_at_x1_m - height_m) * (x - x0) / (x1 - x0);
  }
};

struct Overflight {
  std::vector<Box> boxes;
  MultilevelFilter filter{MultilevelFilter::Config{}};
  common::RandomStream random{1, "altitude"};

  double scan_hz = 40.0;
  int beams = 10;
  double spread_rad = 0.035;
  double beam_sigma_m = 0.01;
  double acceleration_sigma_m_s2 = 0.1;
  double acceleration_bias_m_s2 = 0.0;
  double outlier_rate = 0.0, dropout_rate = 0.0;
  double height_offset_m = 0.0;  ///< Offset of all beams: a wrong mirror mount.
  bool sees_slopes = false;      ///< A camera told the gradients of the ground.
  double gradient_error = 0.0;   ///< Of all of them, along x.

  common::Time now;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double z_m = 0.15, vz_m_s = 0.0;
  double worst_error_m = 0.0, squares_m2 = 0.0;
  int scans = 0, added = 0, joined = 0, without_measurement = 0;
  double estimated_m = 0.15;
  AltitudeUpdate last;
  std::optional<double> regained_m;  ///< The last correction by the floor.

  /// Boxes of all heights side by side along x, few of them wide enough to become a level. Returns where they end.
  double addClutter(double from_m, double to_m, double lowest_m, double highest_m) {
    while (from_m < to_m) {
      const double next_m = from_m + random.uniform(0.06, 0.15);
      boxes.push_back({from_m, next_m, -1.0, 1.0, random.uniform(lowest_m, highest_m)});
      from_m = next_m;
    }
    return from_m;
  }

  double surface(const Eigen::Vector2d& at) const {
    double height_m = 0.0;
    for (const Box& box : boxes)
      if (at.x() >= box.x0 && at.x() < box.x1 && at.y() >= box.y0 && at.y() < box.y1)
        height_m = std::max(height_m, box.heightAt(at.x()));
    return height_m;
  }

  /// Of the ground below, as a camera sees it: level where it is nearly so.
  Eigen::Vector2d gradient() const {
    const Eigen::Vector2d step(0.02, 0.0);
    const double along = (surface(position_m + step) - surface(position_m - step)) / 0.04;
    return {std::abs(along) < 0.05 || std::abs(along) > 0.5 ? 0.0 : along + gradient_error, 0.0};
  }

  void start() { filter.initialize(now, position_m, z_m); }

  /// One scan after 1 / scan_hz of constant acceleration.
  void scan(double acceleration_m_s2) {
    const int steps = static_cast<int>(std::lround(200.0 / scan_hz));
    InertialClimb climb{0.0, 0.0, acceleration_sigma_m_s2 * std::sqrt(0.005)};
    for (int i = 0; i < steps; ++i) {
      now += common::Duration::fromMilliseconds(5);
      z_m += vz_m_s * 0.005 + 0.5 * acceleration_m_s2 * 0.005 * 0.005;
      vz_m_s += acceleration_m_s2 * 0.005;
      const double felt_m_s2 = acceleration_m_s2 + acceleration_bias_m_s2 + random.gaussian(acceleration_sigma_m_s2);
      climb.height_m += climb.velocity_m_s * 0.005 + 0.5 * felt_m_s2 * 0.005 * 0.005;
      climb.velocity_m_s += felt_m_s2 * 0.005;
    }
    std::vector<GroundPoint> points;
    for (int i = 0; i < beams; ++i) {
      const double angle = beams > 1 ? spread_rad * (static_cast<double>(i) / (beams - 1) - 0.5) : 0.0;
      Eigen::Vector2d at = position_m + Eigen::Vector2d(0.0, std::tan(angle) * z_m);
      double below_m = z_m - surface(at) + height_offset_m + random.gaussian(beam_sigma_m);
      if (random.chance(dropout_rate)) below_m = std::numeric_limits<double>::quiet_NaN();
      if (random.chance(outlier_rate)) below_m = random.uniform(0.1, 6.0);
      points.push_back({at, below_m});
    }
    last = filter.update({.stamp = now,
                          .position_map_m = position_m,
                          .points = points,
                          .known = filter.state(),
                          .climb = climb,
                          .gradient_map = sees_slopes ? std::optional(gradient()) : std::nullopt});
    if (last.floor_regained_m) regained_m = last.floor_regained_m;
    added += last.levels_added;
    joined += last.levels_joined;
    without_measurement += last.vertical ? 0 : 1;
    estimated_m = filter.state().height_m;
    const double error_m = estimated_m - z_m;
    worst_error_m = std::max(worst_error_m, std::abs(error_m));
    squares_m2 += error_m * error_m;
    ++scans;
  }

  /// Climbs (or sinks) to a height in place, smoothly.
  void climbTo(double goal_m, double speed_m_s = 0.5) {
    while (std::abs(goal_m - z_m) > 1e-3 || std::abs(vz_m_s) > 1e-3) {
      const double stoppable = std::sqrt(2.0 * 0.8 * std::abs(goal_m - z_m));
      const double wanted = std::copysign(std::min(speed_m_s, stoppable), goal_m - z_m);
      const double settle = std::abs(goal_m - z_m) * 10.0;
      scan(std::clamp((std::copysign(std::min(std::abs(wanted), settle), wanted) - vz_m_s) * scan_hz, -1.0, 1.0));
    }
  }

  /// Flies straight to a place, with small changes of height.
  void flyTo(const Eigen::Vector2d& goal_m, double speed_m_s = 0.5) {
    const double hold_m = z_m;
    while ((goal_m - position_m).norm() > 1e-6) {
      const double step_m = std::min(speed_m_s / scan_hz, (goal_m - position_m).norm());
      position_m += step_m * (goal_m - position_m).normalized();
      scan(std::clamp(4.0 * (hold_m - z_m) - 2.0 * vz_m_s + random.gaussian(0.3), -2.0, 2.0));
    }
  }

  double rms_m() const { return std::sqrt(squares_m2 / scans); }
};

}  // namespace swiftlet::perception
