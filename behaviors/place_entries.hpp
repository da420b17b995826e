// The entries by which a mission names what is in a topological map: a place and a passage are points, a danger zone is
// the corners of an area. `<MoveToGoal goal="{kitchen}"/>`, `<KeepOut polygon="{stairs}"/>`.
#pragma once

#include "behaviors/mission_limits.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

/// How a mission within these limits is read: the names of its places are set by the host.
tree::ParseOptions parseOptionsOf(const MissionLimits& limits);
/// Sets the entries of a tree that was read so. A passage has the height of its middle, a place none.
void setPlaces(const MissionLimits& limits, tree::Tree& tree);

}  // namespace swiftlet::behaviors
