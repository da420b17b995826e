#include "common/trajectory.hpp"

#include <algorithm>

namespace swiftlet::common {

Ordered ordered(std::vector<StampedPose> poses) {
  Ordered result;
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses[i].stamp < poses[i - 1].stamp) ++result.went_back;
  std::stable_sort(poses.begin(), poses.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  for (const StampedPose& pose : poses) {
    if (!result.trajectory.empty() && result.trajectory.back().stamp == pose.stamp) {
      result.trajectory.back() = pose;
      ++result.repeated;
    } else {
      result.trajectory.push_back(pose);
    }
  }
  return result;
}

}  // namespace swiftlet::common
