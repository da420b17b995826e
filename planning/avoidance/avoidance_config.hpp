// The configuration of the reactive layer.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::planning {

/// kMean is the rule of Saeedi, but its mean over 5 deg hides a thin pole. kRobustMinimum is the least of the medians
/// of three neighbouring beams, which a single stray return does not change.
enum class AvoidanceBinRange { kMean, kRobustMinimum };

/// How the course of a retreat is chosen.
enum class RetreatRule {
  kClearCourse,     ///< Of many courses that end at rest and clear of everything, the one farthest from people.
  kOpposite,        ///< 180 deg from the bin of the collision (Saeedi, III-G).
  kPotentialField,  ///< The sum of repulsive forces of all returns (Grzonka 2012, IV-E, after Khatib 1986).
};

struct AvoidanceConfig {
  double field_of_view_deg = 270.0;  ///< Angle centred on the nose in which the layer relies on the laser.
  AvoidanceBinRange bin_range = AvoidanceBinRange::kRobustMinimum;
  double max_speed_m_s = 1.5;
  double deceleration_m_s2 = 1.0;
  double latency_s = 0.12;
  double lag_s = 0.08;
  double margin_m = 0.05;
  double retreat_distance_m = 0.25;  ///< Something unmapped nearer to the hull than this makes the vehicle retreat.
  RetreatRule retreat_rule = RetreatRule::kClearCourse;

  /// Sectors into which the field of view is divided: of 5 deg, as those of Saeedi, section III-G, with 270 deg.
  static constexpr int bins = 54;
  /// Speed limit on a course that the laser does not see (docs/decisions/avoidance.md#009).
  static constexpr double blind_speed_m_s = 0.3;
  /// Something moving that passes nearer than this to the hull counts as arriving.
  static constexpr double contact_gap_m = 0.20;
  /// Greatest speed of a retreat by the rules of the papers (docs/decisions/avoidance.md#009).
  static constexpr double retreat_speed_m_s = 0.7;
  /// Distance between hull and obstacle when a retreat has ended.
  static constexpr double retreat_margin_m = 0.15;
  /// Factor on distances and times while retreating, so that a retreat does not flicker.
  static constexpr double release_factor = 1.3;

  void describe(common::config::Fields& fields);
  /// Conflicts between these distances and the clearance that the planner may use: a distance is refused if it would
  /// stop the vehicle, or make it retreat, on a path that the planner may take. Empty without conflicts.
  std::vector<common::Problem> validateAgainst(double clearance_m, double keep_out_m) const;
};

}  // namespace swiftlet::planning
