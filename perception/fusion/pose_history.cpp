#include "perception/fusion/pose_history.hpp"

#include <algorithm>
#include <utility>

#include "common/check.hpp"

namespace swiftlet::perception {

PoseHistory::PoseHistory(std::vector<common::StampedPose> poses) : poses_(std::move(poses)) {
  for (std::size_t i = 1; i < poses_.size(); ++i)
    SWIFTLET_CHECK(poses_[i - 1].stamp < poses_[i].stamp, i, poses_[i].stamp.nanoseconds());
}

bool PoseHistory::covers(common::Time time) const {
  return !poses_.empty() && time >= poses_.front().stamp && time <= poses_.back().stamp;
}

std::optional<common::Pose3> PoseHistory::at(common::Time time) const {
  if (!covers(time)) return std::nullopt;
  if (poses_.size() == 1) return poses_.front().pose;
  const auto holds = [&](std::size_t i) { return poses_[i].stamp <= time && time <= poses_[i + 1].stamp; };
  if (!holds(segment_)) {
    const bool next = segment_ + 2 < poses_.size() && holds(segment_ + 1);
    if (next) {
      ++segment_;
    } else {
      const auto after =
          std::upper_bound(poses_.begin() + 1, poses_.end() - 1, time,
                           [](common::Time t, const common::StampedPose& pose) { return t < pose.stamp; });
      segment_ = static_cast<std::size_t>(after - poses_.begin()) - 1;
    }
  }
  const common::StampedPose& before = poses_[segment_];
  const common::StampedPose& after = poses_[segment_ + 1];
  const double share = (time - before.stamp).seconds() / (after.stamp - before.stamp).seconds();
  return common::blended(before.pose, after.pose, share);
}

}  // namespace swiftlet::perception
