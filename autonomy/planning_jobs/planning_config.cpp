#include "autonomy/planning_jobs/planning_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

void PlanningConfig::describe(common::config::Fields& fields) {
  fields.section("cost_map", cost_map, "Where the vehicle may be.");
  fields.section("explorer", explorer, "Where to look from next.");
  fields.section("exploration", exploration, "Frontiers and viewpoints.");
  fields.section("planner", planner, "Paths to goals and to viewpoints.");
  fields.section("lower", lower, "Flying below what hangs over the path.");
  fields("planning_latency_s", latency_s, {0.0, 2.0}, "Declared time of a planning job.");
  fields("planning_period_s", period_s, {0.05, 5.0},
         "Time between updates of the cost map, which is never older than this plus the latency.");
}

}  // namespace swiftlet::autonomy
