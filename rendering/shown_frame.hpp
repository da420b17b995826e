// The frame in which places are presented: the axes and metre lines of pictures, and the page's coordinates.
#pragma once

#include "common/geometry.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::rendering {

struct ShownFrame {
  bool given = false;         ///< The frame is that of the given map; otherwise `map`.
  common::Pose2 T_map_shown;  ///< The identity for `map`.
};

/// The frame of the given map while the vehicle knows its place in it, else `map` (docs/decisions/localization.md#060).
/// The page has the same rule, in MapStore.shown().
ShownFrame shownFrame(const common::World& world);

}  // namespace swiftlet::rendering
