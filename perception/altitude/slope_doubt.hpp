// Notices that what was taken for level ground may slope, where no camera sees the ground: a surface that seems to rise
// evenly while the vehicle flies along is a ramp, or the vehicle sinks unnoticed. The multilevel filter takes it for
// level and corrects the vertical speed. A correction that is larger than the errors of the vertical speed in flights
// over furniture indicates a ramp; the height is then wrong by what the ramp rises (docs/decisions/altitude.md#061).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/altitude/height_measurement.hpp"

namespace swiftlet::perception {

/// One thread.
class SlopeDoubt {
 public:
  /// Least correction of the vertical speed that makes the height doubtful. Measured in tests: over furniture below
  /// 0.05, over a ramp of 10 degrees at 0.7 m/s above 0.13.
  static constexpr double kLeast_m_s = 0.08;

  /// A scan of that time and place, and what the filter measured. Returns the correction of the vertical speed,
  /// positive upwards, if it makes the height doubtful.
  std::optional<double> add(common::Time time, const Eigen::Vector2d& place_odom_m,
                            const std::optional<VirtualHeight>& measurement);

 private:
  std::optional<common::Time> time_;
  Eigen::Vector2d place_odom_m_ = Eigen::Vector2d::Zero();
  double speed_m_s_ = 0.0;  ///< Horizontal, smoothed.
};

}  // namespace swiftlet::perception
