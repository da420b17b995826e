// What could not work in flight, seen in the tree alone.
#pragma once

#include <vector>

#include "behaviors/mission.hpp"
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

}  // namespace swiftlet::behaviors
