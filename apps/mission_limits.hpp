// What a system profile lets a mission ask for, and the check of a mission against it.
#pragma once

#include <string>
#include <vector>

#include "apps/system.hpp"
#include "behaviors/mission.hpp"

namespace swiftlet::apps {

behaviors::MissionLimits missionLimits(const System& system);

/// Every problem of a mission, that of its file included, if it is to be flown with this system.
std::vector<common::Problem> missionProblems(const std::string& mission, const System& system);

/// Throws common::InputError with all of them; for what is about to fly.
void requireSound(const std::string& mission, const System& system);

}  // namespace swiftlet::apps
