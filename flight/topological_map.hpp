// The topological map of a flight.
#pragma once

#include "common/topological_map.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::flight {

/// Places, passages and danger zones of a flight: those that it was given, those that its mission names, and those that
/// it has found. Only the found ones while it is not localized in its given map, in whose frame the others are.
common::TopologicalMap topologicalMapOf(const common::World& world, const common::TopologicalMap* given);

}  // namespace swiftlet::flight
