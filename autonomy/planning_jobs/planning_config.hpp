// How paths and viewpoints are found.
#pragma once

#include "common/config_fwd.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner_choice.hpp"

namespace swiftlet::autonomy {

/// How the vehicle changes its height where no path leads on at the height of flight.
struct LowerFlightConfig {
  bool enabled = true;

  void describe(common::config::Fields& fields);
};

struct PlanningConfig {
  planning::CostMap::Config cost_map;
  planning::ExplorerConfig explorer;
  planning::PlannerConfig planner;
  LowerFlightConfig lower;
  double latency_s = 0.06;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
