// The strapdown step and the propagation of its error (Tomic 2012, "Data Fusion"). Attitude errors are in odom.
#pragma once

#include <Eigen/Core>

#include "common/gravity.hpp"
#include "common/time.hpp"
#include "perception/fusion/filter_state.hpp"

namespace swiftlet::perception::fusion {

struct ImuValue {
  common::Time stamp;
  Eigen::Vector3d angular_velocity_body_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_body_m_s2 = Eigen::Vector3d::Zero();
};

struct ImuNoise {
  double accelerometer_m_s2_rthz = 0.0;
  double gyroscope_rad_s_rthz = 0.0;
  double accelerometer_walk_m_s3_rthz = 0.0;
  double gyroscope_walk_rad_s2_rthz = 0.0;
  double drag_walk_1_s_rts = 0.0;      ///< Random walk of the drag.
  double wind_walk_m_s_rts = 0.0;      ///< Random walk of the wind.
  double ahrs_yaw_walk_rad_rts = 0.0;  ///< Random walk of the AHRS's yaw, beside its drift.
  double gravity_m_s2 = common::kGravity_m_s2;
};

/// Propagates state and covariance from `begin` to `end` by the midpoint rule. state.stamp must be begin.stamp. The
/// clones do not change; their correlations do.
void propagate(FilterState& state, const ImuValue& begin, const ImuValue& end, const ImuNoise& noise);

/// The transition matrix of the core error that `propagate` applies; for tests.
Eigen::Matrix<double, kCore, kCore> transition(const FilterState& state, const ImuValue& begin, const ImuValue& end);

}  // namespace swiftlet::perception::fusion
