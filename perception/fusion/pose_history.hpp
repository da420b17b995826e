// A short stretch of estimated poses, interpolated: position linearly, rotation along the shortest arc. Made to deskew
// a scan: a few segments, asked a thousand times in rising order of time.
#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "common/trajectory.hpp"

namespace swiftlet::perception {

/// One thread: at() remembers where it looked.
class PoseHistory {
 public:
  PoseHistory() = default;
  /// `poses` in strictly rising order of time.
  explicit PoseHistory(std::vector<common::StampedPose> poses);

  const std::vector<common::StampedPose>& poses() const { return poses_; }
  bool covers(common::Time time) const;

  /// None outside of the stretch. About 30 ns when asked in order.
  std::optional<common::Pose3> at(common::Time time) const;

 private:
  std::vector<common::StampedPose> poses_;
  mutable std::size_t segment_ = 0;  ///< Where the last question fell; only speeds up the next one.
};

/// The pose between two others; `share` is 0 at the first and 1 at the second.
common::Pose3 interpolate(const common::Pose3& first, const common::Pose3& second, double share);

}  // namespace swiftlet::perception
