// What a mission that can be flown probably does not mean.
#pragma once

#include <vector>

#include "behaviors/mission_limits.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

/// - A node that is never ticked, because one before it always succeeds, always fails, or never ends, or because a
///   condition, a case or a count that the file fixes excludes it.
/// - A Parallel of several children that fly: only the last intent of a tick is flown.
/// - No node lands the vehicle, and no OperatorCommand leaves that to the operator; or the mission may succeed in the
///   air.
/// - What operatorWarnings() finds.
/// Each has the path of its node.
std::vector<tree::Problem> missionWarnings(const tree::Tree& tree, const MissionLimits& limits);

/// Nodes that wait for an operator who is not there.
std::vector<tree::Problem> operatorWarnings(const tree::Tree& tree, const MissionLimits& limits);

}  // namespace swiftlet::behaviors
