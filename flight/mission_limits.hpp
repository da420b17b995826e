// The limits that a system profile sets to a mission, and the check of a mission against them.
#pragma once

#include <string>
#include <vector>

#include "behaviors/mission_limits.hpp"
#include "behaviors/tree/registry.hpp"
#include "flight/system.hpp"

namespace swiftlet::flight {

/// How far the hull reaches below the plane of the laser, if no camera with depths looks there; otherwise 0.
double unseenBelow_m(const System& system);

behaviors::MissionLimits missionLimits(const System& system, bool has_map);

/// Every problem of a mission, that of its file included, if it is to be flown with this system, and with a map of
/// the place or without.
std::vector<common::Problem> missionProblems(const std::string& mission, const System& system, bool has_map,
                                             const tree::Registry& types);

}  // namespace swiftlet::flight
