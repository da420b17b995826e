// Poses at a time and relative poses between two times, for files and metrics.
#pragma once

#include <cstddef>
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

/// A trajectory made from poses in any order.
struct Ordered {
  Trajectory trajectory;
  std::size_t went_back = 0;  ///< Number of poses whose stamp is before that of the preceding input pose.
  std::size_t repeated = 0;   ///< Number of poses left out because a later input pose has the same stamp.
};
Ordered ordered(std::vector<StampedPose> poses);

/// The relative pose of an object between two times: its pose at `to` in the frame of its pose at `from`.
struct Relation {
  Time from;
  Time to;
  Pose3 T_from_to;
};

}  // namespace swiftlet::common
