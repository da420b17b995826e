#include "control/smoothed_reference.hpp"

#include <cmath>

namespace swiftlet::control {

/// With e = reference - smooth: e'' = a - 2 w e' - w^2 e, w = 1 / tau, solved exactly for an acceleration a that is
/// constant during the tick.
Reference SmoothedReference::advance(Reference reference, double lag_s, double dt_s) {
  if (lag_s <= 0.0) return reference;
  const double w = 1.0 / lag_s, decay = std::exp(-w * dt_s);
  const Eigen::Vector2d settled_m = lag_s * lag_s * reference.acceleration_odom_m_s2.head<2>();
  const Eigen::Vector2d off_m = behind_m_ - settled_m;
  const Eigen::Vector2d slope_m_s = behind_m_s_ + w * off_m;
  behind_m_ = settled_m + decay * (off_m + dt_s * slope_m_s);
  behind_m_s_ = decay * (slope_m_s - w * (off_m + dt_s * slope_m_s));
  reference.position_odom_m.head<2>() -= behind_m_;
  reference.velocity_odom_m_s.head<2>() -= behind_m_s_;
  return reference;
}

}  // namespace swiftlet::control
