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
  static constexpr int bins = 54;    ///< Sectors into which the field of view is divided.
  double field_of_view_deg = 270.0;  ///< Angle centred on the nose in which the layer relies on the laser.
  AvoidanceBinRange bin_range = AvoidanceBinRange::kRobustMinimum;
  static constexpr int smoothing_window = 5;  ///< Beams of the sliding mean that `mean` smooths with.
  double max_speed_m_s = 1.5;
  double deceleration_m_s2 = 1.0;
  static constexpr double blind_speed_m_s = 0.3;  ///< Speed limit on a course that the laser does not see.
  double latency_s = 0.12;
  double lag_s = 0.08;
  double margin_m = 0.05;
  double retreat_distance_m = 0.25;  ///< Something unmapped nearer to the hull than this makes the vehicle retreat.
  static constexpr double contact_time_s =
      1.8;  ///< Something moving that would arrive within this time makes the vehicle retreat.
  static constexpr double contact_gap_m = 0.20;  ///< Passing nearer than this to the hull counts as arriving.
  static constexpr double closing_speed_m_s =
      0.15;  ///< An obstacle that approaches more slowly than this does not count as moving.
  static constexpr double mapped_within_m =
      0.15;  ///< A return this near to something mapped or unknown is not unmapped.
  RetreatRule retreat_rule = RetreatRule::kClearCourse;
  static constexpr double field_range_m =
      1.0;  ///< Distance from the hull within which a return repels, for the rule potential_field.
  static constexpr double retreat_speed_m_s = 0.7;  ///< Greatest speed of a retreat.
  static constexpr double retreat_margin_m = 0.15;  ///< Distance between hull and obstacle when a retreat has ended.
  static constexpr double view_margin_deg = 30.0;   ///< While retreating the vehicle turns until the danger and its
                                                    ///< course are this far within the field of view.
  static constexpr double release_factor =
      1.3;  ///< Factor on distances and times while retreating, so that a retreat does not flicker.
  static constexpr double calm_s = 0.6;          ///< A retreat ends this long after the danger.
  static constexpr double self_radius_m = 0.10;  ///< Returns nearer to the origin than this are the vehicle itself.

  void describe(common::config::Fields& fields);
  /// Conflicts between these distances and the clearance that the planner may use: a distance is refused if it would
  /// stop the vehicle, or make it retreat, on a path that the planner may take. Empty without conflicts.
  std::vector<std::string> validateAgainst(double clearance_m, double keep_out_m) const;
};

}  // namespace swiftlet::planning
