// How fast the estimated height drifts away from what the beams down measure, while the vehicle hardly moves over the
// ground. No ground slopes so much that a vehicle that hovers over it would measure this, so the vertical speed is
// wrong: a camera may take a climb for rest, and the levels below would then be taken for others.
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::perception {

/// The vehicle climbs faster than estimated by `speed_m_s`.
struct HeightDriftRate {
  double speed_m_s = 0.0;
  double variance_m2_s2 = 0.0;
};

/// One thread.
class HeightDrift {
 public:
  /// A scan of that time and place: the distance down to what is below, and the estimated height over the take-off
  /// floor. A jump of their difference is an edge below or a correction of the height; what was before it is forgotten.
  /// Returns the rate of their difference if neither noise nor a slope explains it.
  std::optional<HeightDriftRate> add(common::Time time, const Eigen::Vector2d& place_odom_m, double below_m,
                                     double height_m);

 private:
  struct Sample {
    common::Time time;
    Eigen::Vector2d place_odom_m;
    double difference_m;
  };
  std::deque<Sample> samples_;
};

}  // namespace swiftlet::perception
