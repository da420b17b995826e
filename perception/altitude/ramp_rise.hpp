// How much higher than the level it came from the ground below is, while the vehicle flies over a slope: the integral
// of the gradient along its path. With it, the beams down measure the height over that level also above a ramp.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// One thread.
///
///            the ground below slopes                     level for kEnds_m
///   level ------------------------------> on a slope -------------------------> level (on another height)
///                                            the rise adds up                    the rise starts from zero
class RampRise {
 public:
  /// The vehicle has flown to that place. Path is measured in `odom`, as a loop closure moves the vehicle in the map
  /// and not over the ground. `gradient_map`: that of the ground there; none if it is not known, which counts as a
  /// continuation of what was before for a short path.
  /// Returns the rise of the slope that has just ended; none otherwise.
  std::optional<double> move(const common::Pose2& T_map_odom, const Eigen::Vector2d& place_odom_m,
                             const std::optional<Eigen::Vector2d>& gradient_map);

  bool onSlope() const { return on_slope_; }
  /// Rise of the ground below over the level from which the slope began; 0 over level ground.
  double rise_m() const { return rise_m_; }
  /// On a slope, the variance of rise_m() by the error of the gradients, which is the same along the whole slope. After
  /// the slope, the variance that the height has from it until the ground there has been measured.
  double variance_m2() const;
  /// A known level below has given a measurement of the height.
  void measured() {
    if (!on_slope_) path_m_ = 0.0;
  }

 private:
  bool on_slope_ = false;
  double rise_m_ = 0.0;
  double path_m_ = 0.0;       ///< Over slopes.
  double off_slope_m_ = 0.0;  ///< Path since the ground last sloped.
  std::optional<Eigen::Vector2d> place_odom_m_;
  Eigen::Vector2d gradient_map_ = Eigen::Vector2d::Zero();  ///< The last one.
};

}  // namespace swiftlet::perception
