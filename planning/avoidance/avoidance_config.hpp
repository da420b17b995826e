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
  kClearCourse,     ///< Of many courses that end at rest and clear of everything the one farthest from people.
  kOpposite,        ///< 180 deg from the bin of the collision (Saeedi, III-G).
  kPotentialField,  ///< The sum of repulsive forces of all returns (Grzonka 2012, IV-E, after Khatib 1986).
};

struct AvoidanceConfig {
  int bins = 54;
  double field_of_view_deg = 270.0;
  AvoidanceBinRange bin_range = AvoidanceBinRange::kRobustMinimum;
  int smoothing_window = 5;
  double max_speed_m_s = 1.5;
  double deceleration_m_s2 = 1.0;
  double blind_speed_m_s = 0.3;
  double latency_s = 0.12;
  double lag_s = 0.08;
  double margin_m = 0.05;
  double retreat_distance_m = 0.25;
  double contact_time_s = 1.8;
  double contact_gap_m = 0.20;
  double closing_speed_m_s = 0.15;
  double mapped_within_m = 0.15;
  RetreatRule retreat_rule = RetreatRule::kClearCourse;
  double field_range_m = 1.0;
  double retreat_speed_m_s = 0.7;
  double retreat_margin_m = 0.15;
  double view_margin_deg = 30.0;
  double release_factor = 1.3;
  double calm_s = 0.6;
  double self_radius_m = 0.10;

  void describe(common::config::Fields& fields);
  /// Conflicts between these distances and the clearance that the planner may use: a distance is refused if it would
  /// stop the vehicle, or make it retreat, on a path that the planner may take. Empty if there are none.
  std::vector<std::string> validateAgainst(double clearance_m, double keep_out_m) const;
};

}  // namespace swiftlet::planning
