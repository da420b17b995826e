// What a system profile lets a mission ask for, and the check of a mission against it.
#pragma once

#include <string>
#include <vector>

#include "apps/system.hpp"
#include "behaviors/mission.hpp"
#include "behaviors/mission_limits.hpp"

namespace swiftlet::apps {

behaviors::MissionLimits missionLimits(const System& system, bool has_map);

/// Every problem of a mission, that of its file included, if it is to be flown with this system, and with a map of
/// the place or without.
std::vector<common::Problem> missionProblems(const std::string& mission, const System& system, bool has_map = true);

/// Throws common::InputError with all of them; for what is about to fly.
void requireSound(const std::string& mission, const System& system, bool has_map);

}  // namespace swiftlet::apps
