#include "interfaces/laser_log/mount_survey.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::interfaces {
namespace {

using common::Pose2;

constexpr std::size_t kFewRecords = 20, kManyRecords = 5000;
/// The distance a pose must move, so that a changing distance between the poses shows.
constexpr double kMoved_m = 1.0;
/// Logs are printed with six digits, to 1 cm and 0.01 rad at worst (beyond 1 km).
constexpr double kSame_m = 0.02, kSame_rad = 0.02;
constexpr double kMostRecords = 0.9;

template <typename Value>
double median(const std::vector<Pose2>& poses, Value&& valueOf) {
  std::vector<double> values;
  for (const Pose2& pose : poses) values.push_back(valueOf(pose));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double distance_m(const Pose2& a, const Pose2& b) { return (a.position_m() - b.position_m()).norm(); }

}  // namespace

bool agrees(const Pose2& T_robot_laser, const LaserMount& mount) {
  const Pose2& expected = mount.T_robot_laser;
  return distance_m(T_robot_laser, expected) <= kSame_m &&
         std::abs(common::wrapAngle(T_robot_laser.yaw_rad - expected.yaw_rad)) <= kSame_rad;
}

void MountSurvey::add(const Pose2& T_odom_laser, const Pose2& T_odom_robot) {
  if (mounts_.empty()) {
    first_laser_ = T_odom_laser;
    first_robot_ = T_odom_robot;
  }
  mounts_.push_back(T_odom_robot.inverse() * T_odom_laser);
  laser_moved_m_ = std::max(laser_moved_m_, distance_m(first_laser_, T_odom_laser));
  robot_moved_m_ = std::max(robot_moved_m_, distance_m(first_robot_, T_odom_robot));
}

bool MountSurvey::decided() const {
  if (mounts_.size() >= kManyRecords) return true;
  return mounts_.size() >= kFewRecords && std::max(laser_moved_m_, robot_moved_m_) >= kMoved_m;
}

LaserMount MountSurvey::result() const {
  LaserMount mount;
  if (mounts_.empty()) return mount;
  const double about_rad = mounts_.front().yaw_rad;
  mount.T_robot_laser = {median(mounts_, [](const Pose2& pose) { return pose.x_m; }),
                         median(mounts_, [](const Pose2& pose) { return pose.y_m; }),
                         common::wrapAngle(about_rad + median(mounts_, [&](const Pose2& pose) {
                                             return common::wrapAngle(pose.yaw_rad - about_rad);
                                           }))};
  const auto same =
      std::count_if(mounts_.begin(), mounts_.end(), [&](const Pose2& pose) { return agrees(pose, mount); });
  mount.rigid = static_cast<double>(same) >= kMostRecords * static_cast<double>(mounts_.size());
  if (mount.rigid) return mount;
  mount.T_robot_laser = {};
  mount.robot_stands = robot_moved_m_ <= kSame_m && laser_moved_m_ > kMoved_m;
  return mount;
}

}  // namespace swiftlet::interfaces
