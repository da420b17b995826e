// Openings among the recognized objects of the World, as the leaves that fly through them use them.
#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/world.hpp"
#include "common/world/objects_layer.hpp"

namespace swiftlet::behaviors {

/// Nothing of the World is changed while a tick lasts, so pointers to its objects are valid that long.
using ObjectPointers = std::vector<const common::RecognizedObject*>;

/// Those of that name within a horizontal distance of a place, the nearest first; none without a recognizer.
ObjectPointers objectsNear(const common::World& world, std::string_view what, const Eigen::Vector2d& place_map_m,
                           double within_m);
/// Null without one.
const common::RecognizedObject* objectWithId(const common::World& world, int id);

/// It is confirmed as open, and at least that wide.
bool isOpenFor(const common::RecognizedObject& opening, double width_m);

/// The direction of a flight through an opening from that place, horizontal, of length 1.
Eigen::Vector2d directionThrough(const common::RecognizedObject& opening, const Eigen::Vector2d& from_map_m);

}  // namespace swiftlet::behaviors
