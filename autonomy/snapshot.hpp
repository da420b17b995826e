// The parts of the snapshot that Autonomy publishes.
#pragma once

#include "autonomy/commander.hpp"
#include "autonomy/navigator.hpp"
#include "autonomy/percept.hpp"
#include "autonomy/world_builder.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// `percept` has the surroundings; `last` is the snapshot before, null before the first.
WorldParts partsOf(const Percept& percept, const Commander& commander, const Navigator& navigator,
                   const common::World* last);

}  // namespace swiftlet::autonomy
