// Whether a mission keeps within the limits that the rest of the system sets to it.
#pragma once

#include <optional>
#include <vector>

#include "behaviors/mission_limits.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

/// - A clearance that the reactive layer forbids, or a goal that cannot be valid in any map (common/goal.hpp).
/// - A node that needs a camera, targets or a map that the flight does not have.
/// - A file's name, an area or flight modes that no flight can take.
std::vector<tree::Problem> limitProblems(const tree::Tree& tree, const MissionLimits& limits);

/// The greatest `max_height_m` of the tree's TakeOffs; nullopt if none names one.
std::optional<double> maxHeightOf_m(const tree::Tree& tree);
/// Whether the vehicle flies home before it lands if the mission fails: unless a TakeOff says otherwise.
bool fliesHomeOnFailure(const tree::Tree& tree);

}  // namespace swiftlet::behaviors
