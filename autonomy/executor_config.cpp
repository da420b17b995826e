// The configuration of the executor.
#include "autonomy/executor.hpp"
#include "common/validation.hpp"

namespace swiftlet::autonomy {

void ExecutorConfig::describe(common::config::Fields& fields) {
  fields.section("cost_map", cost_map, "Where the vehicle may be.");
  fields.section("exploration", exploration, "Frontiers and viewpoints.");
  fields.section("plan_keeper", plan_keeper, "How long a plan is kept.");
  fields("planning_latency_s", planning_latency_s, "Declared for a planning job.");
  fields("planning_period_s", planning_period_s, "How often the cost map is brought up to date.");
  fields("explore_period_s", explore_period_s, "How often the next viewpoint is thought over.");
  fields("clearance_m", clearance_m, "Between hull and obstacle, where an intent names none.");
  fields("arrival_speed_m_s", arrival_speed_m_s, "A goal is reached when slower than this.");
  fields("arrival_s", arrival_s, "A goal is reached when within its tolerance for this long.");
  fields("viewpoint_tolerance_m", viewpoint_tolerance_m, "How near a viewpoint counts as reached.");
  fields("viewpoint_tolerance_deg", viewpoint_tolerance_deg, "How well it must be turned to.");
  fields("detour_after_s", detour_after_s,
         "Without a way for this long it goes nearer to look, or aside to make room.");
  fields("detour_s", detour_s, "The longest that may take.");
  fields("give_up_s", give_up_s, "Without a way to the goal for this long the intent fails.");
}

std::vector<std::string> ExecutorConfig::validate() const {
  return common::Validation()
      .within("planning_latency_s", planning_latency_s, 0.0, 2.0)
      .within("planning_period_s", planning_period_s, 0.05, 5.0)
      .within("explore_period_s", explore_period_s, 0.1, 10.0)
      .within("clearance_m", clearance_m, 0.0, 2.0)
      .positive("arrival_speed_m_s", arrival_speed_m_s)
      .within("arrival_s", arrival_s, 0.0, 5.0)
      .positive("viewpoint_tolerance_m", viewpoint_tolerance_m)
      .positive("viewpoint_tolerance_deg", viewpoint_tolerance_deg)
      .positive("give_up_s", give_up_s)
      .positive("detour_after_s", detour_after_s)
      .positive("detour_s", detour_s)
      .problems();
}

}  // namespace swiftlet::autonomy
