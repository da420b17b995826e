// How intents are carried out: planning, and detours while there is no path.
#pragma once

#include "autonomy/planning_jobs/planning_config.hpp"
#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct ExecutorConfig {
  PlanningConfig planning;  ///< Its keys are at this level of the file.
  double clearance_m = 0.10;
  double detour_after_s = 2.5;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
