// The node types of missions.
#pragma once

#include <memory>

#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

/// What missions are read with. Immutable; each mission shares it, as its tree needs it.
using NodeTypes = std::shared_ptr<const tree::Registry>;

/// The engine's nodes and Swiftlet's leaves, made anew: leaves of one's own may be added (`registry.add<Circle>()`).
tree::Registry missionRegistry();
/// The same, made once and shared.
NodeTypes missionNodes();

}  // namespace swiftlet::behaviors
