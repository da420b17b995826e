// Whether a camera without a seed may be where a key frame or its last pose says that it is.
#pragma once

#include "common/geometry.hpp"
#include "mapping3d/odometry/alignment.hpp"

namespace swiftlet::mapping3d {

/// Whether a camera can have come from `last` to `found` within `gap_s`. After 5 s it can be anywhere.
bool isInReach(const common::Pose3& last, const common::Pose3& found, double gap_s);

/// Whether two poses are near enough to be one and the same place found twice.
bool isSamePlace(const common::Pose3& a, const common::Pose3& b);

/// Whether a frame that fits shows enough of its key frames, and looks enough like them, to be found by it: with enough
/// points of texture, since surfaces alone are alike in many places.
bool isRecognized(const Alignment& fit);

/// Whether an alignment ended where corners say that the camera is.
bool isConfirmed(const Alignment& fit, const common::Pose3& by_corners);

/// A fit that no wrong pose has, even where no corners confirm it.
bool isSure(const Alignment& fit);

/// A weak fit, far from where the bounds of the acceleration allow the camera to be: mostly of a blurred picture.
bool isLeap(const Alignment& fit, const PosePrior& prior);

}  // namespace swiftlet::mapping3d
