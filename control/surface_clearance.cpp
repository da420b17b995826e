#include "control/surface_clearance.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::control {

void SurfaceClearance::Config::describe(common::config::Fields& fields) {
  fields("least_m", least_m, {0.2, 5},
         "Least height of the body over what is below; a path that is nearer to the floor itself stays so.");
}

void SurfaceClearance::observe(const RawHeight& below, double height_m) {
  const double surface_m = height_m - below.height_m;
  if (!std::isfinite(surface_m)) return;
  const bool passed = !highest_ || (below.stamp - highest_->seen).seconds() > config_.behind_s;
  if (passed || surface_m >= highest_->height_m) highest_ = Surface{below.stamp, surface_m};
}

void SurfaceClearance::advance(common::Time now, double wanted_m, double dt_s) {
  // Without a measurement nothing is known to be below.
  if (highest_ && (now - highest_->seen).seconds() > 2.0 * config_.behind_s) highest_.reset();
  const double least_m = std::min(config_.least_m, wanted_m);
  const double needed_m = highest_ ? std::max(0.0, highest_->height_m + least_m - wanted_m) : 0.0;
  const double step_m = std::clamp(needed_m - lift_m_, -config_.sink_m_s * dt_s, config_.climb_m_s * dt_s);
  lift_m_ += step_m;
  rate_m_s_ = step_m / dt_s;
}

void SurfaceClearance::reset() {
  highest_.reset();
  lift_m_ = rate_m_s_ = 0.0;
}

}  // namespace swiftlet::control
