#include "control/surface_clearance.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::control {

namespace {

constexpr double kClimb_m_s = 0.4;  ///< Climb speed over an edge.
constexpr double kSink_m_s = 0.2;   ///< Descent speed behind an edge.
constexpr double kBehind_s = 1.0;   ///< Time for which the hull is still over what its middle has passed.

}  // namespace

void SurfaceClearance::observe(const RawHeight& below, double height_m) {
  const double surface_m = height_m - below.height_m;
  if (!std::isfinite(surface_m)) return;
  const bool passed = !highest_ || (below.stamp - highest_->seen).seconds() > kBehind_s;
  if (passed || surface_m >= highest_->height_m) highest_ = Surface{below.stamp, surface_m};
}

Reference SurfaceClearance::raised(Reference path, common::Time now, double max_height_m, double dt_s) {
  const double path_m = path.position_odom_m.z();
  // Without a measurement nothing is known to be below.
  if (highest_ && (now - highest_->seen).seconds() > 2.0 * kBehind_s) highest_.reset();
  const double least_m = std::min(least_m_, path_m);
  const double needed_m = highest_ ? std::max(0.0, highest_->height_m + least_m - path_m) : 0.0;
  const double step_m = std::clamp(needed_m - wanted_lift_m_, -kSink_m_s * dt_s, kClimb_m_s * dt_s);
  wanted_lift_m_ += step_m;
  const double height_m = std::min(path_m + wanted_lift_m_, std::max(max_height_m, path_m));
  lift_m_ = height_m - path_m;
  if (lift_m_ > 0.0) path.velocity_odom_m_s.z() += step_m / dt_s;
  path.position_odom_m.z() = height_m;
  return path;
}

void SurfaceClearance::reset() {
  highest_.reset();
  wanted_lift_m_ = lift_m_ = 0.0;
}

void SurfaceClearance::Config::describe(common::config::Fields& fields) {
  fields("least_m", least_m, {0.2, 5},
         "Least height of the body over what is below; a path that is nearer to the floor itself stays so.");
}

}  // namespace swiftlet::control
