#include "apps/pose_seeds.hpp"

#include <algorithm>

#include "interfaces/files/tum.hpp"

namespace swiftlet::apps {
namespace {

/// Between poses farther apart, an even motion cannot be assumed.
constexpr double kLongestGap_s = 0.5;

}  // namespace

PoseSeeds::PoseSeeds(const std::string& file)
    : poses_(common::ordered(interfaces::readTum(file, interfaces::StampOrder::kAny)).trajectory) {}

std::optional<common::Pose3> PoseSeeds::at(common::Time stamp) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const common::StampedPose& pose, common::Time t) { return pose.stamp < t; });
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == poses_.begin()) return std::nullopt;
  const common::StampedPose& before = *(after - 1);
  const double gap_s = (after->stamp - before.stamp).seconds();
  if (gap_s > kLongestGap_s) return std::nullopt;
  const double part = (stamp - before.stamp).seconds() / gap_s;
  return common::Pose3{before.pose.rotation.slerp(part, after->pose.rotation),
                       before.pose.position_m + part * (after->pose.position_m - before.pose.position_m)};
}

}  // namespace swiftlet::apps
