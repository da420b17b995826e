// What a mission that can be flown probably does not mean.
#pragma once

#include <vector>

#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

/// - A node that is never ticked, because one before it always succeeds, always fails, or never ends.
/// - A Parallel of several children that fly: only the last intent of a tick is flown.
/// - Nothing lands the vehicle, and no OperatorCommand leaves that to the operator.
/// Each has the path of its node.
std::vector<tree::Problem> missionWarnings(const tree::Tree& tree);

}  // namespace swiftlet::behaviors
