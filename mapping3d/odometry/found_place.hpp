// Whether a camera without a seed may be where a key frame or its last pose says that it is.
#pragma once

#include "common/geometry.hpp"
#include "mapping3d/odometry/alignment.hpp"

namespace swiftlet::mapping3d {

/// Whether a camera can have come from `last` to `found` within `gap_s`. After 5 s it can be anywhere.
bool isInReach(const common::Pose3& last, const common::Pose3& found, double gap_s);

/// Whether two poses are near enough to be one and the same place found twice.
bool isSamePlace(const common::Pose3& a, const common::Pose3& b);

/// Whether a frame that fits shows enough of its key frames, and looks enough like them, to be found by it: with at
/// least this many points of texture, since surfaces alone are alike in many places.
bool isRecognized(const Alignment& fit, int least_textured);

/// A weak fit, far from where the bounds of the acceleration allow the camera to be: mostly of a blurred picture.
bool isLeap(const Alignment& fit, const PosePrior& prior);

}  // namespace swiftlet::mapping3d
