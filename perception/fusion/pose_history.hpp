// A short sequence of estimated poses with interpolation: position linearly, rotation along the shortest arc. Made for
// deskewing a scan: a few segments and a thousand queries in ascending order of time.
#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "common/trajectory.hpp"

namespace swiftlet::perception {

/// Not thread-safe, not even for reading: at() remembers the last segment.
class PoseHistory {
 public:
  PoseHistory() = default;
  /// `poses` must be in strictly ascending order of time.
  explicit PoseHistory(std::vector<common::StampedPose> poses);

  const std::vector<common::StampedPose>& poses() const { return poses_; }
  bool covers(common::Time time) const;

  /// nullopt outside the sequence. Takes about 30 ns when queried in ascending order.
  std::optional<common::Pose3> at(common::Time time) const;

 private:
  std::vector<common::StampedPose> poses_;
  mutable std::size_t segment_ = 0;  ///< Segment of the last query; only speeds up the next one.
};

}  // namespace swiftlet::perception
