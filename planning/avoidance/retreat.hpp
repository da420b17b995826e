// The course of a retreat. Candidates are courses of bounded acceleration that end at rest; of those that stay clear of
// everything else, the one with the widest gap to people is flown (admissible velocities of Fox, Burgard, Thrun: "The
// dynamic window approach to collision avoidance", 1997, for a vehicle that flies in any direction).
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "planning/avoidance/avoidance_config.hpp"
#include "planning/avoidance/contact_risk.hpp"
#include "planning/clearance/clearance.hpp"

namespace swiftlet::planning {

/// An unmapped or moving obstacle, in the level frame.
struct Threat {
  Eigen::Vector2d center_m;
  double radius_m;
  Eigen::Vector2d velocity_m_s;
  bool dangerous;
  std::string why;

  /// The gap to the hull after `time_s`, if the vehicle has moved by `moved_m`. Negative if they overlap.
  double gapTo(double hull_radius_m, const Eigen::Vector2d& moved_m, double time_s) const {
    return (center_m + velocity_m_s * time_s - moved_m).norm() - radius_m - hull_radius_m;
  }
};

/// The inputs at one scan. The level frame is the body frame without roll and pitch.
struct RetreatInput {
  Eigen::Vector2d velocity_level_m_s;
  std::span<const Eigen::Vector2d> points_level_m;  ///< Returns in order of bearing.
  std::span<const Threat> threats;
  Eigen::Vector2d last_level_m_s;  ///< The result at the previous scan; zero at first.
  common::Pose2 T_map_level;
  const Clearance* clearance;           ///< From the obstacles that the laser does not see; may be null.
  double latency_s;                     ///< From the scan to the moment when a command acts.
  const ContactRisk* people = nullptr;  ///< Null: nobody walks.
};

/// Where the vehicle is at every step, if it flies that velocity after the latency for `going_s`, and then brakes to
/// rest.
ContactRisk::Course courseOf(const Eigen::Vector2d& velocity_now_m_s, const Eigen::Vector2d& wanted_m_s, double going_s,
                             double latency_s, double acceleration_m_s2);

/// Greatest speed and acceleration of a course. To leave the width of hull and person, 0.53 m, from rest takes 0.7 s
/// with 2 m/s^2, a tilt of 12 deg, and 1.0 s with 1 m/s^2: a person at 1.4 m/s comes 0.4 m nearer meanwhile.
inline constexpr double kRetreatSpeed_m_s = 1.0, kRetreatAcceleration_m_s2 = 2.0;

struct RetreatChoice {
  Eigen::Vector2d velocity_level_m_s = Eigen::Vector2d::Zero();
  double contact = 0.0;  ///< Probability that a person is met on it.
};

/// The velocity to fly until the next scan, in the level frame; zero if stopping is best. If it is flown with
/// kRetreatAcceleration_m_s2 and computed again at each scan, the hull comes no nearer to a static
/// obstacle than `retreat_margin_m`, or than it would by stopping at once. A pure function.
RetreatChoice retreatChoice(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input);

}  // namespace swiftlet::planning
