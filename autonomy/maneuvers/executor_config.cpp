// The configuration of the executor.
#include "autonomy/maneuvers/executor_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::config::kPositive;

void ExecutorConfig::describe(common::config::Fields& fields) {
  planning.describe(fields);
  fields.section("plan_keeper", plan_keeper, "How long a plan is kept.");
  fields("explore_period_s", explore_period_s, {0.1, 10.0}, "Least time between choices of the next viewpoint.");
  fields("explore_period_share", explore_period_share, {0.0, 1.0},
         "Least time between choices of the next viewpoint as a share of the flight time to the present one.");
  fields("clearance_m", clearance_m, {0.0, 2.0}, "Distance between hull and obstacle where an intent names none.");
  fields("arrival_speed_m_s", arrival_speed_m_s, kPositive,
         "A goal is reached only when the vehicle is slower than this.");
  fields("arrival_s", arrival_s, {0.0, 5.0},
         "A goal is reached when the vehicle has been within its tolerance for this long.");
  fields("viewpoint_tolerance_m", viewpoint_tolerance_m, kPositive, "Distance at which a viewpoint counts as reached.");
  fields("viewpoint_tolerance_deg", viewpoint_tolerance_deg, kPositive,
         "Yaw error at which a viewpoint counts as reached.");
  fields("detour_after_s", detour_after_s, kPositive,
         "Without a path for this long the vehicle goes nearer to look, or aside to make room.");
  fields("detour_s", detour_s, kPositive, "Longest time of going nearer or aside; a path is asked for meanwhile.");
  fields("give_up_s", give_up_s, kPositive, "Without a path to the goal for this long the intent fails.");
  fields.section("follow", follow, "Following a person.");
}

}  // namespace swiftlet::autonomy
