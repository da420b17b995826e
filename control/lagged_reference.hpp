// The horizontal reference as a vehicle with a lagging attitude can follow it.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "control/reference.hpp"

namespace swiftlet::control {

/// The reference's acceleration is fed forward at once, but the vehicle takes it up only as its attitude follows. The
/// errors are those from the reference behind the same lag; otherwise each change of speed would look like an error.
/// The vehicle's translational dynamics as a filter of the reference: Tomic 2012, "Action".
class LaggedReference {
 public:
  struct Point {
    Eigen::Vector2d position_odom_m;
    Eigen::Vector2d velocity_odom_m_s;
  };

  /// Follows the reference by one tick, and jumps with it.
  void advance(const Reference& reference, double lag_s, double dt_s);
  /// nullopt while the horizontal position is not held.
  const std::optional<Point>& point() const { return point_; }
  void reset() { point_.reset(); }

 private:
  std::optional<Point> point_;
};

}  // namespace swiftlet::control
