#include "perception/laser_odometry/swept_projection.hpp"

#include <Eigen/Geometry>

namespace swiftlet::perception {

using common::Pose2;

namespace {

Eigen::Isometry2f isometryOf(const Pose2& pose) {
  Eigen::Isometry2f isometry = Eigen::Isometry2f::Identity();
  isometry.rotate(static_cast<float>(pose.yaw_rad)).pretranslate(pose.position_m().cast<float>());
  return isometry;
}

}  // namespace

ProjectedScan projectSwept(const common::LaserScan& scan, const Pose2& T_robot_laser, const Pose2& T_odom_robot,
                           const SweepMotion& motion) {
  // Any height above the floor serves, because no beam is tilted towards it.
  constexpr double kHeight_m = 1.0;
  common::LaserConfig laser;
  laser.mirror_beams = 0;
  laser.mount.x_m = T_robot_laser.x_m;
  laser.mount.y_m = T_robot_laser.y_m;
  laser.mount.yaw_deg = T_robot_laser.yaw_rad / common::kRadPerDeg;

  const common::Time start = scan.stamps.measured;
  const common::Duration sweep = sweepTime(scan);
  common::LaserScan timed = scan;
  if (scan.time_increment < common::Duration()) timed.stamps.measured += sweep;  // Of the first beam in the message.
  const Pose2 T_odom_motion = T_odom_robot * motion.at(0.0).inverse();
  const auto poseAt = [&](common::Time time) {
    return common::lifted(T_odom_motion * motion.at((time - start).seconds() / sweep.seconds()), kHeight_m);
  };
  ProjectedScan result = project(timed, laser, poseAt, {});

  // From the middle of the sweep to its beginning.
  const Eigen::Isometry2f T_start_middle = isometryOf(between(motion.at(0.0), motion.at(0.5)));
  for (Eigen::Vector2f& point : result.points_level_m) point = T_start_middle * point;
  for (std::vector<Eigen::Vector3f>* points : {&result.misses_level_m, &result.no_returns_level_m})
    for (Eigen::Vector3f& point : *points) point.head<2>() = T_start_middle * Eigen::Vector2f(point.head<2>());
  result.stamp = start;
  result.T_odom_body = common::lifted(T_odom_robot, kHeight_m);
  return result;
}

}  // namespace swiftlet::perception
