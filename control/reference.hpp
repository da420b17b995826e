// The reference of the controller: a point that moves smoothly in the odom frame.
#pragma once

#include <Eigen/Core>

namespace swiftlet::control {

struct Reference {
  Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_odom_m_s2 = Eigen::Vector3d::Zero();
  double yaw_odom_rad = 0.0;
  double yaw_rate_rad_s = 0.0;
};

}  // namespace swiftlet::control
