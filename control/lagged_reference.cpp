#include "control/lagged_reference.hpp"

#include "common/first_order_lag.hpp"

namespace swiftlet::control {

void LaggedReference::advance(const Reference& reference, double lag_s, double dt_s) {
  constexpr double kJump_m = 0.3;  // A reference that jumps by more was set again.
  const Eigen::Vector2d position_m = reference.position_odom_m.head<2>();
  const Eigen::Vector2d velocity_m_s = reference.velocity_odom_m_s.head<2>();
  if (!point_ || lag_s <= 0.0 ||
      (point_->position_odom_m + lag_s * point_->velocity_odom_m_s - position_m).norm() > kJump_m)
    point_ = Point{position_m, velocity_m_s};
  if (lag_s <= 0.0) return;
  const double share = common::followedShare(dt_s, lag_s);
  point_->position_odom_m += share * (position_m - point_->position_odom_m);
  point_->velocity_odom_m_s += share * (velocity_m_s - point_->velocity_odom_m_s);
}

}  // namespace swiftlet::control
