#include "autonomy/inertial/horizon_offset.hpp"

#include <algorithm>

#include "common/first_order_lag.hpp"
#include "common/geometry.hpp"

namespace swiftlet::autonomy {
namespace {

/// The fast errors of an AHRS are not to be followed, its lean under acceleration is.
constexpr double kFilter_s = 0.5;
/// No horizon is known to be wrong by more; what exceeds it is a fault of the AHRS or of the estimate.
constexpr double kMost_rad = 3.0 * common::kRadPerDeg;

}  // namespace

void HorizonOffset::observe(common::Time stamp, const Eigen::Quaterniond& ahrs, const Eigen::Quaterniond& estimated) {
  const common::RollPitchYaw told = common::rollPitchYaw(ahrs), known = common::rollPitchYaw(estimated);
  const Eigen::Vector2d now_rad(common::wrapAngle(told.roll_rad - known.roll_rad), told.pitch_rad - known.pitch_rad);
  if (!now_rad.allFinite()) return;
  const double dt_s = last_ ? std::max(0.0, (stamp - *last_).seconds()) : 0.0;
  last_ = stamp;
  offset_rad_ += common::followedShare(dt_s, kFilter_s) * (now_rad - offset_rad_);
  offset_rad_ = offset_rad_.cwiseMax(-kMost_rad).cwiseMin(kMost_rad);
}

}  // namespace swiftlet::autonomy
