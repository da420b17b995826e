// The configuration of every explorer.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::planning {

struct ExplorationConfig {
  static constexpr double min_frontier_m = 0.30;  ///< Shorter frontiers are left as too small.
  static constexpr double segment_m = 1.5;        ///< Longer frontiers are cut into pieces of at most this length.
  double laser_range_m = 12.0;                    ///< Range within which a viewpoint is expected to see.
  double laser_field_of_view_deg = 270.0;         ///< Angle centred on the heading that a viewpoint is expected to see.
  static constexpr double gain_depth_m = 2.0;     ///< Depth of the unknown that a beam is expected to see.
  static constexpr double gain_exponent =
      0.6;  ///< Utility grows with the gain to this power; at 0 only the travel time counts.
  static constexpr double min_gain_m2 = 0.03;       ///< A frontier behind which less is expected is left as too small.
  static constexpr double speed_m_s = 0.8;          ///< Speed from which travel times are estimated.
  static constexpr double yaw_rate_rad_s = 1.0;     ///< Yaw rate from which travel times are estimated.
  static constexpr double acceleration_m_s2 = 0.8;  ///< Acceleration from which travel times are estimated.
  static constexpr double hysteresis =
      0.25;  ///< The present viewpoint is left only for one that is better by this share.
  static constexpr double localizability_weight =
      0.3;  ///< Share of the utility that is lost where the laser would not fix the pose.
  static constexpr double least_wall_share =
      0.55;  ///< A frontier around which a smaller share of the directions ends at walls is not explored, as outside an
             ///< open door. One endless wall, which fixes one direction only, is half of them.
  static constexpr double wall_range_m = 25.0;  ///< Range within which walls count for least_wall_share.
  static constexpr double open_m = 5.0;  ///< A direction that is free as far as this without a wall counts as open.
  static constexpr double max_unheld_m = 4.0;  ///< Longest stretch of a path around which less than least_wall_share
                                               ///< ends at walls; a viewpoint behind a longer one is not chosen.
  static constexpr double lost_radius_m =
      4.0;  ///< Frontiers this near to a target during whose approach the position became uncertain are not explored.
  static constexpr int max_attempts = 3;  ///< A frontier that remains after this many views is not tried again.
  static constexpr double attempt_radius_m = 0.35;  ///< Views from this near to a frontier count as attempts at it.
  static constexpr int max_evaluated =
      30;  ///< Frontiers, from the nearest on, for which viewpoints are evaluated in one call.
};

}  // namespace swiftlet::planning
