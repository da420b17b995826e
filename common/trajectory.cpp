#include "common/trajectory.hpp"

#include <algorithm>

namespace swiftlet::common {

Pose3 interpolated(const Pose3& first, const Pose3& second, double share) {
  return {first.rotation.slerp(share, second.rotation),
          first.position_m + share * (second.position_m - first.position_m)};
}

Pose3 blended(const Pose3& first, const Pose3& second, double share) {
  const double sign = first.rotation.dot(second.rotation) < 0.0 ? -1.0 : 1.0;
  Pose3 pose;
  pose.rotation.coeffs() =
      ((1.0 - share) * first.rotation.coeffs() + sign * share * second.rotation.coeffs()).normalized();
  pose.position_m = first.position_m + share * (second.position_m - first.position_m);
  return pose;
}

std::size_t nearestTo(const Trajectory& trajectory, Time time) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), time,
                                      [](const StampedPose& pose, Time t) { return pose.stamp < t; });
  const auto index = static_cast<std::size_t>(after - trajectory.begin());
  if (index == 0) return 0;
  if (index == trajectory.size()) return index - 1;
  return time - trajectory[index - 1].stamp <= trajectory[index].stamp - time ? index - 1 : index;
}

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
