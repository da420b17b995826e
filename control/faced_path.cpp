#include "control/faced_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/segment.hpp"

namespace swiftlet::control {

void FacedPath::lay(std::vector<common::Facing> facings_odom) {
  facings_ = std::move(facings_odom);
  at_ = 0;
  share_ = 0.0;
}

void FacedPath::move(const common::Pose2& T_new_old) {
  for (common::Facing& facing : facings_) {
    facing.place_m = T_new_old * facing.place_m;
    facing.yaw_rad = common::wrapAngle(facing.yaw_rad + T_new_old.yaw_rad);
  }
}

void FacedPath::advance(const Eigen::Vector2d& carrot_odom_m) {
  constexpr double kSame_m = 1e-6;  // Of two stretches that are equally near the later one counts.
  const auto off_m = [&](std::size_t stretch) {
    return common::segmentDistance(carrot_odom_m, facings_[stretch].place_m, facings_[stretch + 1].place_m);
  };
  if (onLast()) return;
  while (at_ + 2 < facings_.size() && off_m(at_ + 1) <= off_m(at_) + kSame_m) {
    ++at_;
    share_ = 0.0;
  }
  share_ = std::max(share_, common::shareNearest(carrot_odom_m, facings_[at_].place_m, facings_[at_ + 1].place_m));
}

double FacedPath::yawAt(std::size_t stretch, double share) const {
  if (stretch + 1 >= facings_.size()) return facings_.back().yaw_rad;
  const double turn_rad = common::wrapAngle(facings_[stretch + 1].yaw_rad - facings_[stretch].yaw_rad);
  return common::wrapAngle(facings_[stretch].yaw_rad + share * turn_rad);
}

double FacedPath::turnAhead_rad_m() const {
  if (at_ + 2 >= facings_.size() || lengthOf(at_ + 1) <= 0.0) return 0.0;
  return common::wrapAngle(facings_[at_ + 2].yaw_rad - facings_[at_ + 1].yaw_rad) / lengthOf(at_ + 1);
}

double FacedPath::allowedSpeed_m_s(double braking_m_s2, const Nose& nose) const {
  constexpr double kFarthest_m = 1.0;  // Farther than the vehicle brakes for the blind speed from 1.2 m/s.
  constexpr double kLag_rad = 10.0 * common::kRadPerDeg;  // So far the nose may be behind.
  constexpr double kLeast_m_s = 0.03;                     // The carrot gets on.
  double speed_m_s = std::numeric_limits<double>::infinity();
  double ahead_m = 0.0;
  for (std::size_t i = at_; i + 1 < facings_.size() && ahead_m < kFarthest_m; ++i) {
    const double left_m = (i == at_ ? 1.0 - share_ : 1.0) * lengthOf(i);
    double turn_rad = std::abs(common::wrapAngle(facings_[i + 1].yaw_rad - facings_[i].yaw_rad));
    if (i == at_) turn_rad = std::min(turn_rad, std::abs(common::wrapAngle(facings_[i + 1].yaw_rad - nose.yaw_rad)));
    double slowest_m_s = facings_[i].speed_m_s;
    if (turn_rad > kLag_rad)
      slowest_m_s = std::min(slowest_m_s, std::max(kLeast_m_s, left_m * nose.rate_rad_s / (turn_rad - kLag_rad)));
    speed_m_s = std::min(speed_m_s, std::sqrt(slowest_m_s * slowest_m_s + 2.0 * braking_m_s2 * ahead_m));
    ahead_m += left_m;
  }
  return speed_m_s;
}

double FacedPath::lengthOf(std::size_t stretch) const {
  return (facings_[stretch + 1].place_m - facings_[stretch].place_m).norm();
}

}  // namespace swiftlet::control
