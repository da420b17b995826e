// What could not work in flight, seen in the tree alone.
#pragma once

#include <string>
#include <vector>

#include "behaviors/mission_limits.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/tree.hpp"
#include "common/error.hpp"

namespace swiftlet::behaviors {

/// The same problems in the words of common.
std::vector<common::Problem> toCommon(const std::vector<tree::Problem>& problems);

/// - Something flies (Explore, Localize, MoveToGoal, GoHome, OperatorCommand) or lands where, by the statuses that
///   lead there, the vehicle stands on the floor; or nothing ever takes off.
/// - A clearance the reactive layer forbids, or a goal that no map could make one to fly to (common/goal.hpp).
/// - A child of a Priority, not the last, that is never SKIPPED: what stands below it could never keep the vehicle.
std::vector<tree::Problem> semanticProblems(const tree::Tree& tree, const MissionLimits& limits);

/// Every problem of a mission file, without flying it: those of the XML, and what could not work in flight (flies
/// before it takes off, a clearance the reactive layer forbids, a branch that never gets the vehicle). Empty: it is
/// sound.
std::vector<common::Problem> checkMission(const std::string& path, const MissionLimits& limits = {});
std::vector<common::Problem> checkMissionText(const std::string& text, const std::string& name,
                                              const MissionLimits& limits = {});

}  // namespace swiftlet::behaviors
