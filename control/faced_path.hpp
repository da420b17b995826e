// The yaws that were planned along a path, as the carrot comes by.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/facing.hpp"
#include "common/geometry.hpp"

namespace swiftlet::control {

/// lay() first; without facings nothing is planned.
class FacedPath {
 public:
  void lay(std::vector<common::Facing> facings_odom);
  /// Moves the places by T_new_old, after T_map_odom has jumped.
  void move(const common::Pose2& T_new_old);
  /// The carrot is here. It goes on along the path, which it may leave by the rounding of a corner.
  void advance(const Eigen::Vector2d& carrot_odom_m);

  bool empty() const { return facings_.empty(); }
  /// The yaw where the carrot is. Not if empty().
  double yaw_rad() const { return yawAt(at_, share_); }
  /// The yaw a stretch ahead of it, to which the nose turns: also while the carrot is held up. Not if empty().
  double yawAhead_rad() const { return yawAt(at_ + 1, share_); }
  /// How the yaw turns along the path there.
  double turnAhead_rad_m() const;
  /// How the nose turns: what it has, and how fast it may.
  struct Nose {
    double yaw_rad = 0.0;
    double rate_rad_s = 1.0;
  };
  /// The speed at which the carrot may go on, so that it can brake for every slower stretch ahead; infinity if none is.
  /// A stretch is slower where it was planned so, and where the nose has more to turn than it can on the way: where it
  /// has turned already, it is not waited for.
  double allowedSpeed_m_s(double braking_m_s2, const Nose& nose) const;

 private:
  bool onLast() const { return at_ + 1 >= facings_.size(); }
  double yawAt(std::size_t stretch, double share) const;
  double lengthOf(std::size_t stretch) const;

  std::vector<common::Facing> facings_;
  std::size_t at_ = 0;  ///< The carrot is between this place and the next.
  double share_ = 0.0;  ///< Of that stretch, behind the carrot.
};

}  // namespace swiftlet::control
