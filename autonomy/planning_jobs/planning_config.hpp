// How paths and viewpoints are found, and how often.
#pragma once

#include "autonomy/planning_jobs/lower_flight_config.hpp"
#include "common/config_fwd.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner_choice.hpp"

namespace swiftlet::autonomy {

struct PlanningConfig {
  planning::CostMap::Config cost_map;
  planning::ExplorerConfig explorer;
  planning::PlannerConfig planner;
  LowerFlightConfig lower;
  double latency_s = 0.06;
  static constexpr double period_s =
      0.25;  ///< Time between updates of the cost map, which is never older than this plus the latency.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
