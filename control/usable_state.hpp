// Whether a state can be computed with at all.
#pragma once

#include "common/vehicle_state.hpp"

namespace swiftlet::control {

inline bool isFinite(const common::VehicleState& state) {
  return common::isFinite(state.T_odom_body) && state.velocity_odom_m_s.allFinite() &&
         state.velocity_covariance_m2_s2.allFinite();
}

}  // namespace swiftlet::control
