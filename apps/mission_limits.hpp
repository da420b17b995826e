// The limits that a system profile sets to a mission, and the check of a mission against them.
#pragma once

#include <string>
#include <vector>

#include "apps/system.hpp"
#include "behaviors/mission.hpp"
#include "behaviors/mission_limits.hpp"

namespace swiftlet::apps {

behaviors::MissionLimits missionLimits(const System& system, bool has_map);

/// Every problem of a mission, including those of its file, if it is flown with this system, with or without a given
/// map.
std::vector<common::Problem> missionProblems(const std::string& mission, const System& system, bool has_map = true);

/// The mission of that file for a flight: read once and checked. Throws common::InputError with all problems.
behaviors::Mission soundMission(const std::string& file, const System& system, bool has_map);

}  // namespace swiftlet::apps
