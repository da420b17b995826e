// Poses in time and between times, as files and metrics take them.
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

/// The trajectory that poses in any order come to.
struct Ordered {
  Trajectory trajectory;
  std::size_t went_back = 0;  ///< Poses whose stamp is before that of the pose they followed.
  std::size_t repeated = 0;   ///< Poses left out because a later one has the same stamp: the last word counts.
};
Ordered ordered(std::vector<StampedPose> poses);

/// Where something was at one time as seen from where it was at another.
struct Relation {
  Time from;
  Time to;
  Pose3 T_from_to;
};

}  // namespace swiftlet::common
