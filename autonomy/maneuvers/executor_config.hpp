// How intents are carried out: planning, exploring, arriving, and detours while there is no path.
#pragma once

#include "autonomy/maneuvers/follow_config.hpp"
#include "autonomy/planning_jobs/planning_config.hpp"
#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct ExecutorConfig {
  PlanningConfig planning;                         ///< Its keys are at this level of the file.
  static constexpr double explore_period_s = 0.5;  ///< Least time between choices of the next viewpoint.
  static constexpr double explore_period_share =
      0.15;  ///< Least time between choices of the next viewpoint as a share of the flight time to the present one.
  double clearance_m = 0.10;
  static constexpr double arrival_speed_m_s = 0.15;  ///< A goal is reached only when the vehicle is slower than this.
  static constexpr double arrival_s =
      0.25;  ///< A goal is reached when the vehicle has been within its tolerance for this long.
  static constexpr double viewpoint_tolerance_m = 0.15;    ///< Distance at which a viewpoint counts as reached.
  static constexpr double viewpoint_tolerance_deg = 12.0;  ///< Yaw error at which a viewpoint counts as reached.
  double give_up_s = 60.0;
  double detour_after_s = 2.5;
  static constexpr double detour_s = 15.0;  ///< Longest time of going nearer or aside; a path is requested meanwhile.
  FollowConfig follow;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
