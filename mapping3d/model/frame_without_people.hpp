// Frames without what lies on people.
#pragma once

#include <span>

#include "common/disc.hpp"
#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::mapping3d {

/// The frame without the depths that lie on people, whose discs are in `map`, at any height: what moves with them must
/// not align later frames, and makes no points.
common::RgbdFrame withoutPeople(common::RgbdFrame frame, const common::Pose3& T_map_camera,
                                std::span<const common::Disc> people);

}  // namespace swiftlet::mapping3d
