#include "perception/slam2d/uncertain_pose.hpp"

#include <Eigen/LU>

namespace swiftlet::perception {

UncertainPose weightedMean(const UncertainPose& moved, const UncertainPose& matched) {
  const common::Pose2& from = moved.T_map_body;
  const common::Pose2& to = matched.T_map_body;
  const Eigen::Matrix3d gain = moved.covariance * (moved.covariance + matched.covariance).inverse();
  const Eigen::Vector3d step =
      gain * Eigen::Vector3d(to.x_m - from.x_m, to.y_m - from.y_m, common::wrapAngle(to.yaw_rad - from.yaw_rad));
  return {{from.x_m + step.x(), from.y_m + step.y(), common::wrapAngle(from.yaw_rad + step.z())},
          moved.covariance - gain * moved.covariance};
}

}  // namespace swiftlet::perception
