#include "perception/altitude/slope_doubt.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {
namespace {

/// Slower, nothing below changes because of the path.
constexpr double kLeastSpeed_m_s = 0.2;
constexpr double kSmoothing_s = 0.5;  ///< Of the speed from scan to scan; a ramp takes longer.

}  // namespace

std::optional<double> SlopeDoubt::add(common::Time time, const Eigen::Vector2d& place_odom_m,
                                      const std::optional<VirtualHeight>& measurement) {
  if (const double dt_s = time_ ? (time - *time_).seconds() : 0.0; dt_s > 0.0) {
    const double speed_m_s = (place_odom_m - place_odom_m_).norm() / dt_s;
    speed_m_s_ += std::min(1.0, dt_s / kSmoothing_s) * (speed_m_s - speed_m_s_);
  }
  time_ = time;
  place_odom_m_ = place_odom_m;
  if (!measurement || !measurement->speed || speed_m_s_ < kLeastSpeed_m_s) return std::nullopt;
  const double change_m_s = measurement->speed->change_m_s;
  return std::abs(change_m_s) < kLeast_m_s ? std::nullopt : std::optional(change_m_s);
}

}  // namespace swiftlet::perception
