#include "rendering/shown_frame.hpp"

#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::rendering {

ShownFrame shownFrame(const common::World& world) {
  const auto& T_map_given = world.map->T_map_given;
  return T_map_given ? ShownFrame{true, *T_map_given} : ShownFrame{};
}

}  // namespace swiftlet::rendering
