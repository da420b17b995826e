// Which way to go from what comes: courses of bounded acceleration that end at rest, the one that keeps the widest gap
// to everybody among those that stay clear of everything else (the admissible velocities of Fox, Burgard, Thrun: "The
// dynamic window approach to collision avoidance", 1997, for a vehicle that flies in any direction).
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "planning/avoidance/avoidance_config.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// Something unmapped or moving, in the level frame.
struct Threat {
  Eigen::Vector2d center_m;
  double radius_m;
  Eigen::Vector2d velocity_m_s;
  bool dangerous;
  std::string why;

  /// What is left between the two after that time, when the vehicle has gone by `moved_m`. Negative: they touch.
  double gapTo(double hull_radius_m, const Eigen::Vector2d& moved_m, double time_s) const {
    return (center_m + velocity_m_s * time_s - moved_m).norm() - radius_m - hull_radius_m;
  }
};

/// What is known at one scan. The level frame is the body frame without roll and pitch.
struct RetreatInput {
  Eigen::Vector2d velocity_level_m_s;
  std::span<const Eigen::Vector2d> points_level_m;  ///< Returns in order of bearing.
  std::span<const Threat> threats;
  Eigen::Vector2d last_level_m_s;  ///< What was answered at the scan before; zero at first.
  common::Pose2 T_map_level;
  const CostMap* cost_map;  ///< Answers for what the laser does not see; may be null.
};

/// The velocity to fly until the next scan, in the level frame; zero: to stop is best. Whoever flies it with the
/// `deceleration_m_s2` of the configuration, and asks again at each scan, comes no nearer to anything that stands than
/// `retreat_margin_m` off the hull, or than stopping at once would have brought him. Pure.
Eigen::Vector2d retreatVelocity(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input);

}  // namespace swiftlet::planning
