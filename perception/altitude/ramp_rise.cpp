#include "perception/altitude/ramp_rise.hpp"

#include "common/square.hpp"
#include "perception/altitude/ground_slopes.hpp"

namespace swiftlet::perception {
namespace {

/// A slope has ended when the ground was level along a path of this length: the cells of the gradients are as long.
constexpr double kEnds_m = 0.4;
/// Along this much path without a gradient the slope is believed to go on.
constexpr double kUnseen_m = 0.8;

}  // namespace

std::optional<double> RampRise::move(const Eigen::Vector2d& place_map_m,
                                     const std::optional<Eigen::Vector2d>& gradient) {
  const Eigen::Vector2d step_m = place_map_m_ ? Eigen::Vector2d(place_map_m - *place_map_m_) : Eigen::Vector2d(0, 0);
  place_map_m_ = place_map_m;
  const bool slopes = gradient && !gradient->isZero();
  if (slopes) {
    on_slope_ = true;
    off_slope_m_ = 0.0;
    gradient_ = *gradient;
  }
  if (!on_slope_) return std::nullopt;
  if (!slopes) off_slope_m_ += step_m.norm();
  if (slopes || !gradient) rise_m_ += gradient_.dot(step_m);
  path_m_ += step_m.norm();
  if (off_slope_m_ < (gradient ? kEnds_m : kUnseen_m)) return std::nullopt;
  const double rise_m = rise_m_;
  on_slope_ = false;
  rise_m_ = off_slope_m_ = 0.0;
  return rise_m;
}

double RampRise::variance_m2() const { return common::square(GroundSlopes::kGradientSigma * path_m_); }

}  // namespace swiftlet::perception
