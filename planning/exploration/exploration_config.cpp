#include "common/validation.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::planning {

void ExplorationConfig::describe(common::config::Fields& fields) {
  fields.choice("strategy", strategy, {"nearest", "utility"}, "How the next viewpoint is chosen.");
  fields("min_frontier_m", min_frontier_m, "Shorter frontiers are left as too small.");
  fields("segment_m", segment_m, "Longer frontiers are cut into pieces of at most this length.");
  fields("laser_range_m", laser_range_m, "How far a viewpoint counts on seeing, where the laser does.");
  fields("laser_field_of_view_deg", laser_field_of_view_deg, "Centred on the heading; the laser's where that is less.");
  fields("gain_depth_m", gain_depth_m, "How far into the unknown a beam is expected to see.");
  fields("gain_exponent", gain_exponent, "Utility grows with the gain to this power; 0: the nearest first.");
  fields("min_gain_m2", min_gain_m2, "A frontier behind which less is expected is left as too small.");
  fields("speed_m_s", speed_m_s, "For travel times.");
  fields("acceleration_m_s2", acceleration_m_s2, "For travel times.");
  fields("yaw_rate_rad_s", yaw_rate_rad_s, "For travel times.");
  fields("hysteresis", hysteresis, "The present viewpoint is left only for one better by this share.");
  fields("localizability_weight", localizability_weight, "Share of the utility lost where the laser fixes nothing.");
  fields("max_attempts", max_attempts, "A frontier that stayed after this many looks is blacklisted.");
  fields("attempt_radius_m", attempt_radius_m, "Attempts this near to a frontier count for it.");
  fields("max_evaluated", max_evaluated, "How many of the nearest open frontiers are looked into in one call.");
}

std::vector<std::string> ExplorationConfig::validate() const {
  return common::Validation()
      .within("min_frontier_m", min_frontier_m, 0, 5)
      .within("segment_m", segment_m, 0.2, 20)
      .within("laser_range_m", laser_range_m, 0.5, 100)
      .within("laser_field_of_view_deg", laser_field_of_view_deg, 10, 360)
      .within("gain_depth_m", gain_depth_m, 0.1, 20)
      .within("gain_exponent", gain_exponent, 0, 3)
      .within("min_gain_m2", min_gain_m2, 0, 10)
      .within("speed_m_s", speed_m_s, 0.05, 10)
      .within("acceleration_m_s2", acceleration_m_s2, 0.05, 20)
      .within("yaw_rate_rad_s", yaw_rate_rad_s, 0.05, 10)
      .within("hysteresis", hysteresis, 0, 10)
      .within("localizability_weight", localizability_weight, 0, 1)
      .within("max_attempts", max_attempts, 1, 100)
      .within("attempt_radius_m", attempt_radius_m, 0, 5)
      .within("max_evaluated", max_evaluated, 1, 1000)
      .problems();
}

}  // namespace swiftlet::planning
