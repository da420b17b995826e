// The planner that finds the paths to goals and to viewpoints, as a system profile chooses it.
#pragma once

#include <memory>

#include "common/config_fwd.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// D* Lite repairs its last search (Grzonka 2012). The wavefront starts a new search from the vehicle (Saeedi). With
/// kSampling a path in space (RRT-Connect, planning/sampling) is flown wherever it is shorter than D* Lite's at the
/// height of flight; with the others only where there is none, or a great detour.
enum class PlannerKind { kDStarLite, kWavefront, kSampling };

struct PlannerConfig {
  PlannerKind kind = PlannerKind::kDStarLite;

  void describe(common::config::Fields& fields);
};

std::unique_ptr<Planner> makePlanner(const PlannerConfig& config);

}  // namespace swiftlet::planning
