// The limits that a system profile sets to a mission, and the check of a mission against them.
#pragma once

#include <string>
#include <vector>

#include "apps/system.hpp"
#include "behaviors/mission_limits.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/registry.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::apps {

behaviors::MissionLimits missionLimits(const System& system, bool has_map);

/// The mission file of each vehicle of the scenario, in their order: its own, or else `otherwise`.
std::vector<std::string> missionFiles(const simulation::Scenario& scenario, const std::string& otherwise);

/// "m.xml:4:7: warning: Land: is never reached ... [M/Sequence/Land]"; one line, whatever the names in it hold.
std::string lineOf(tree::Problem problem, bool warning);

/// Every problem of a mission, that of its file included, if it is to be flown with this system, and with a map of
/// the place or without.
std::vector<common::Problem> missionProblems(const std::string& mission, const System& system, bool has_map,
                                             const tree::Registry& types);

}  // namespace swiftlet::apps
