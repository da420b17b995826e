// Poses at a time and relative poses between two times, for files and metrics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
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

/// The pose between two others: the position linearly, the rotation along the shortest arc at an even rate (slerp).
/// `share` is 0 at the first and 1 at the second.
Pose3 interpolated(const Pose3& first, const Pose3& second, double share);
/// The pose between two others that differ by a few hundredths of a radian: the rotation is blended linearly and
/// normalized, which differs from slerp by less than 1e-6 rad there and is four times as fast.
Pose3 blended(const Pose3& first, const Pose3& second, double share);

/// The pose at a time between two poses of a sequence (a vector or deque of StampedPose, ordered like a Trajectory), or
/// at the stamp of one. nullopt before the first and after the last, and, if there is a `longest_gap`, between two that
/// are farther apart.
template <typename Poses>
std::optional<Pose3> poseAt(const Poses& poses, Time time, std::optional<Duration> longest_gap = std::nullopt) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), time,
                                      [](const StampedPose& pose, Time t) { return pose.stamp < t; });
  if (after == poses.end()) return std::nullopt;
  if (after->stamp == time) return after->pose;
  if (after == poses.begin()) return std::nullopt;
  const StampedPose& before = *std::prev(after);
  const Duration gap = after->stamp - before.stamp;
  if (longest_gap && gap > *longest_gap) return std::nullopt;
  return interpolated(before.pose, after->pose, (time - before.stamp).seconds() / gap.seconds());
}

/// The index of the pose nearest in time, the earlier of two that are equally near. `trajectory` is not empty.
std::size_t nearestTo(const Trajectory& trajectory, Time time);

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
