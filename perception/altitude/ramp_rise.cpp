#include "perception/altitude/ramp_rise.hpp"

#include <Eigen/Geometry>

#include "common/square.hpp"
#include "perception/altitude/ground_slopes.hpp"

namespace swiftlet::perception {
namespace {

/// A slope has ended when the ground was level along a path of this length: the cells of the gradients are as long.
constexpr double kEnds_m = 0.4;
/// Along this much path without a gradient the slope is assumed to continue.
constexpr double kUnseen_m = 0.8;

}  // namespace

std::optional<double> RampRise::move(const common::Pose2& T_map_odom, const Eigen::Vector2d& place_odom_m,
                                     const std::optional<Eigen::Vector2d>& gradient_map) {
  const Eigen::Vector2d step_odom_m = place_odom_m - place_odom_m_.value_or(place_odom_m);
  const Eigen::Vector2d step_m = Eigen::Rotation2Dd(T_map_odom.yaw_rad) * step_odom_m;
  place_odom_m_ = place_odom_m;
  const bool slopes = gradient_map && !gradient_map->isZero();
  if (slopes) {
    on_slope_ = true;
    off_slope_m_ = 0.0;
    gradient_map_ = *gradient_map;
  }
  if (!on_slope_) return std::nullopt;
  if (!slopes) off_slope_m_ += step_m.norm();
  if (slopes || !gradient_map) rise_m_ += gradient_map_.dot(step_m);
  path_m_ += step_m.norm();
  if (off_slope_m_ < (gradient_map ? kEnds_m : kUnseen_m)) return std::nullopt;
  const double rise_m = rise_m_;
  on_slope_ = false;
  rise_m_ = off_slope_m_ = 0.0;
  return rise_m;
}

double RampRise::variance_m2() const { return common::square(GroundSlopes::kGradientSigma * path_m_); }

}  // namespace swiftlet::perception
