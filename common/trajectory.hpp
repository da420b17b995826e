// Poses in time, as trajectory files and metrics take them.
#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

struct StampedPose {
  Time stamp;
  Pose3 pose;
};

/// Ordered by stamp, each stamp once.
using Trajectory = std::vector<StampedPose>;

}  // namespace swiftlet::common
