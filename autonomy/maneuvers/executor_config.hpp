// How intents are carried out: planning, exploring, arriving, and detours while there is no path.
#pragma once

#include "autonomy/maneuvers/follow_config.hpp"
#include "autonomy/planning_jobs/planning_config.hpp"
#include "common/config_fwd.hpp"
#include "planning/search/plan_keeper.hpp"

namespace swiftlet::autonomy {

struct ExecutorConfig {
  PlanningConfig planning;  ///< Without a section of its own: its keys stand beside those of the settings below.
  planning::PlanKeeper::Config plan_keeper;
  double explore_period_s = 0.5;
  double explore_period_share = 0.15;
  double clearance_m = 0.10;
  double arrival_speed_m_s = 0.15;
  double arrival_s = 0.25;
  double viewpoint_tolerance_m = 0.15;
  double viewpoint_tolerance_deg = 12.0;
  double give_up_s = 60.0;
  double detour_after_s = 2.5;
  double detour_s = 15.0;
  FollowConfig follow;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
