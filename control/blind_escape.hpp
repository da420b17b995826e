// A short flight away from the walls by the velocity alone, after the position was lost.
#pragma once

#include <algorithm>
#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::control {

/// The velocity is known for longer than the position, so the vehicle leaves the walls into which it would drift while
/// it descends.
class BlindEscape {
 public:
  static constexpr double kSpeed_m_s = 0.3;
  static constexpr double kAcceleration_m_s2 = 0.6;
  /// Longest displacement: a carried velocity that is off by 0.1 m/s leads 0.2 m astray in 2 s. Measured:
  /// docs/decisions/fusion.md#062.
  static constexpr double kReach_m = 2.0 * kSpeed_m_s;

  /// Where to fly if the position is lost from now on; zero to stay.
  void plan(const Eigen::Vector2d& displacement_map_m) { displacement_map_m_ = displacement_map_m; }
  /// Starts to fly the displacement, as far as kReach_m. Returns its length; nullopt, and it does not start, if that is
  /// less than one tick's.
  std::optional<double> start(common::Time now, double dt_s) {
    const double length_m = std::min(displacement_map_m_.norm(), kReach_m);
    if (length_m < kSpeed_m_s * dt_s) return std::nullopt;
    until_ = now + common::Duration::fromSeconds(length_m / kSpeed_m_s);
    return length_m;
  }
  void end() { until_.reset(); }
  bool active() const { return until_.has_value(); }
  /// The displacement has been flown, by time.
  bool flown(common::Time now) const { return until_ && now >= *until_; }
  Eigen::Vector2d velocity_map_m_s() const { return kSpeed_m_s * displacement_map_m_.normalized(); }

 private:
  Eigen::Vector2d displacement_map_m_ = Eigen::Vector2d::Zero();
  std::optional<common::Time> until_;
};

}  // namespace swiftlet::control
