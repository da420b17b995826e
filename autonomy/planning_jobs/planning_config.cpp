#include "autonomy/planning_jobs/planning_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

void LowerFlightConfig::describe(common::config::Fields& fields) {
  fields(
      "enabled", enabled,
      "Whether paths may change their height where the 3D map shows room, and none leads on at the height of flight.");
}

void PlanningConfig::describe(common::config::Fields& fields) {
  fields.section("cost_map", cost_map, "Where the vehicle may be.");
  fields.section("explorer", explorer, "Where to look from next.");
  fields.section("planner", planner, "Paths to goals and to viewpoints.");
  fields.section("lower", lower, "Flying lower or higher where the path is blocked.");
  fields("planning_latency_s", latency_s, {0.0, 2.0}, "Declared time of a planning job.");
}

}  // namespace swiftlet::autonomy
