#include "perception/altitude/slope_doubt.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {
namespace {

/// Slower, nothing below changes because of the path.
constexpr double kLeastSpeed_m_s = 0.2;
constexpr double kSmoothing_s = 0.5;  ///< Of the speed from scan to scan; a ramp takes longer.
/// Longer than the delay of the multilevel filter, 0.15 s.
constexpr double kRemembered_s = 0.5;

}  // namespace

std::optional<double> SlopeDoubt::add(common::Time time, const Eigen::Vector2d& place_odom_m, double velocity_m_s,
                                      const std::optional<VirtualHeight>& measurement) {
  if (const double dt_s = time_ ? (time - *time_).seconds() : 0.0; dt_s > 0.0) {
    const double speed_m_s = (place_odom_m - place_odom_m_).norm() / dt_s;
    speed_m_s_ += std::min(1.0, dt_s / kSmoothing_s) * (speed_m_s - speed_m_s_);
  }
  time_ = time;
  place_odom_m_ = place_odom_m;
  believed_m_s_.emplace_back(time, velocity_m_s);
  while ((time - believed_m_s_.front().first).seconds() > kRemembered_s) believed_m_s_.pop_front();
  if (!measurement || !measurement->velocity_m_s || speed_m_s_ < kLeastSpeed_m_s) return std::nullopt;
  const auto then = std::find_if(believed_m_s_.begin(), believed_m_s_.end(),
                                 [&](const auto& believed) { return believed.first == measurement->stamp; });
  if (then == believed_m_s_.end()) return std::nullopt;
  const double corrected_m_s = *measurement->velocity_m_s - then->second;
  return std::abs(corrected_m_s) < kLeast_m_s ? std::nullopt : std::optional(corrected_m_s);
}

}  // namespace swiftlet::perception
