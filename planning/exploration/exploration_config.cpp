#include "planning/exploration/exploration_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::planning {

void ExplorationConfig::describe(common::config::Fields& fields) {
  fields("min_frontier_m", min_frontier_m, {0, 5}, "Shorter frontiers are left as too small.");
  fields("segment_m", segment_m, {0.2, 20}, "Longer frontiers are cut into pieces of at most this length.");
  fields("laser_range_m", laser_range_m, {0.5, 100}, "Range within which a viewpoint counts on seeing.");
  fields("laser_field_of_view_deg", laser_field_of_view_deg, {10, 360},
         "Angle centred on the heading in which a viewpoint counts on seeing.");
  fields("gain_depth_m", gain_depth_m, {0.1, 20}, "Depth of the unknown that a beam is expected to see.");
  fields("gain_exponent", gain_exponent, {0, 3},
         "Utility grows with the gain to this power; at 0 only the travel time counts.");
  fields("min_gain_m2", min_gain_m2, {0, 10}, "A frontier behind which less is expected is left as too small.");
  fields("speed_m_s", speed_m_s, {0.05, 10}, "Speed from which travel times are estimated.");
  fields("acceleration_m_s2", acceleration_m_s2, {0.05, 20}, "Acceleration from which travel times are estimated.");
  fields("yaw_rate_rad_s", yaw_rate_rad_s, {0.05, 10}, "Yaw rate from which travel times are estimated.");
  fields("hysteresis", hysteresis, {0, 10}, "The present viewpoint is left only for one that is better by this share.");
  fields("localizability_weight", localizability_weight, {0, 1},
         "Share of the utility that is lost where the laser would not fix the pose.");
  fields("least_wall_share", least_wall_share, {0, 1},
         "A frontier around which a smaller share of the directions ends at walls is not explored, as outside an open "
         "door. One endless wall, which fixes one direction only, is half of them.");
  fields("wall_range_m", wall_range_m, {0.5, 100}, "Range within which walls count for least_wall_share.");
  fields("open_m", open_m, {0.5, 100}, "A direction that is free as far as this without a wall counts as open.");
  fields("max_unheld_m", max_unheld_m, {0.5, 1000},
         "Longest stretch of a path around which less than least_wall_share ends at walls; a viewpoint behind a longer "
         "one is not chosen.");
  fields("lost_radius_m", lost_radius_m, {0, 100},
         "Frontiers this near to a target during whose approach the position became uncertain are not explored.");
  fields("max_attempts", max_attempts, {1, 100}, "A frontier that remains after this many views is not tried again.");
  fields("attempt_radius_m", attempt_radius_m, {0, 5}, "Views from this near to a frontier count as attempts at it.");
  fields("max_evaluated", max_evaluated, {1, 1000},
         "Frontiers, from the nearest on, for which viewpoints are evaluated in one call.");
}

}  // namespace swiftlet::planning
