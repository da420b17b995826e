// Buildings that look much like another one: its other floor and its mirror image.
#pragma once

#include <algorithm>
#include <utility>

#include "tests/localization/buildings.hpp"

namespace swiftlet::test {

/// Of offices: what their other floor shares with them.
inline Outline outlineOf(const Building& offices) {
  Outline outline;
  for (const Area& room : offices.rooms) {
    const bool left = room.center().y() > 0.0;
    outline.length_m = std::max(outline.length_m, room.high_m.x());
    outline.half_corridor_m = left ? room.low_m.y() : -room.high_m.y();
    outline.depths_m[left ? 1 : 0] = room.high_m.y() - room.low_m.y();
  }
  return outline;
}

/// The same building in a mirror.
inline Building mirrored(Building building) {
  for (Wall& wall : building.world.walls) wall.a_m.y() *= -1.0, wall.b_m.y() *= -1.0;
  for (Area& room : building.rooms) {
    std::swap(room.low_m.y(), room.high_m.y());
    room.low_m.y() *= -1.0;
    room.high_m.y() *= -1.0;
  }
  building.inside_m.y() *= -1.0;
  return building;
}

}  // namespace swiftlet::test
