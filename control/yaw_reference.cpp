#include "control/yaw_reference.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace swiftlet::control {
namespace {

constexpr double kAcceleration_deg_s2 = 180.0;  ///< Greatest yaw acceleration.
constexpr double kReached_rad = 0.01;           ///< Half a degree, below the error of a hover, 1 deg.
/// A shorter look-ahead gives no reliable direction.
constexpr double kLeastLook_m = 0.05;

}  // namespace

void YawReference::hold(double yaw_odom_rad) {
  setGoal(std::nullopt);
  hold_odom_rad_ = yaw_odom_rad;
}

void YawReference::turn(double yaw_rad) {
  if (goal_odom_rad_) *goal_odom_rad_ += yaw_rad;
}

bool YawReference::reached(double yaw_odom_rad) const {
  return !goal_odom_rad_ || std::abs(common::wrapAngle(*goal_odom_rad_ - yaw_odom_rad)) <= kReached_rad;
}

void YawReference::advance(Reference& reference, const std::optional<PlannedYaw>& planned, bool looks, double dt_s) {
  double turns_rad_s = 0.0;  // The rate of what is faced: of the bearing of a point that the vehicle flies past.
  if (look_at_odom_m_ && looks) {
    const Eigen::Vector2d look = *look_at_odom_m_ - reference.position_odom_m.head<2>();
    if (look.norm() > kLeastLook_m) {
      hold_odom_rad_ = std::atan2(look.y(), look.x());
      const Eigen::Vector3d& velocity = reference.velocity_odom_m_s;
      turns_rad_s = (look.y() * velocity.x() - look.x() * velocity.y()) / look.squaredNorm();
    }
  } else if (planned) {
    hold_odom_rad_ = planned->yaw_odom_rad;
    turns_rad_s = planned->rate_rad_s;
  } else if (goal_odom_rad_) {
    hold_odom_rad_ = *goal_odom_rad_;
  }
  const double error = common::wrapAngle(hold_odom_rad_ - reference.yaw_odom_rad);
  const double most_rad_s = most_deg_s_ * common::kRadPerDeg;
  const double step = kAcceleration_deg_s2 * common::kRadPerDeg * dt_s;
  const double stoppable = std::sqrt(2.0 * kAcceleration_deg_s2 * common::kRadPerDeg * std::abs(error));
  // The last step ends on the goal, so that the carrot does not oscillate about it.
  const double rate = std::min({most_rad_s, stoppable, std::abs(error) / dt_s});
  const double wanted_rad_s = std::clamp(turns_rad_s + std::copysign(rate, error), -most_rad_s, most_rad_s);
  // In steps, braking along the root needs a little more than the acceleration.
  reference.yaw_rate_rad_s =
      std::clamp(wanted_rad_s, reference.yaw_rate_rad_s - 1.2 * step, reference.yaw_rate_rad_s + 1.2 * step);
  reference.yaw_odom_rad = common::wrapAngle(reference.yaw_odom_rad + reference.yaw_rate_rad_s * dt_s);
}

}  // namespace swiftlet::control
