// The figures of what behaviours promise, by the truth.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "evaluation/behavior_recorder.hpp"
#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {

/// A figure is nullopt if it could not be measured.
struct BehaviorScore {
  std::optional<double> keep_out_gap_m;        ///< Least distance of the hull from a keep-out zone, negative inside.
  std::optional<double> inspect_axis_max_deg;  ///< Greatest angle between the camera's axis and the inspected point.
  /// Least share of the floor of a surveyed area that the camera has seen; floor below obstacles does not count.
  std::optional<double> survey_coverage;
  /// Share of the time of following with the person 1.5 to 3 m away: the least share of the flight modes, one after the
  /// other, in which a person was followed, and the shares of the first and of the last mode.
  std::optional<double> follow_share, follow_first_share, follow_last_share;
  std::optional<double> follow_nearest_m;   ///< Least distance between the vehicle's centre and the person's.
  std::optional<double> follow_farthest_m;  ///< Greatest distance between the two.
  std::optional<double> follow_lost_s;      ///< Longest time in which the person was not at the estimated place.
  std::optional<double> targets_found;      ///< See TargetScore; nullopt where the trial requires no targets.
  std::optional<double> target_error_max_m, target_error_median_m, false_targets;
};

/// `T_world_body_views` are the true poses from which the camera saw.
BehaviorScore scoreOf(const BehaviorRecord& record, const TrueWorld& world, const common::Pose3& T_world_map,
                      const std::vector<common::Pose3>& T_world_body_views);

/// The figures by their names in results.json.
std::vector<std::pair<const char*, std::optional<double>>> figuresOf(const BehaviorScore& score);

/// The share of the floor of the area that the camera saw from one of the views, unhidden and within its range.
std::optional<double> surveyCoverage(const common::Polygon& area, const TrueWorld& world,
                                     const common::Pose3& T_world_map,
                                     const std::vector<common::Pose3>& T_world_body_views);

}  // namespace swiftlet::evaluation
