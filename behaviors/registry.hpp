// The node types of a mission.
#pragma once

#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

/// The engine's nodes and the behaviours.
const tree::Registry& missionRegistry();

}  // namespace swiftlet::behaviors
