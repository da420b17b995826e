// Fits the motion within one sweep to what other sweeps have seen. As in CT-ICP (Dellenbach 2022), the poses at several
// times of the sweep are the unknowns, and every point is placed by the pose at its own time; the points are paired
// with the contours of the reference as in PointToLineMatcher. The velocity is expected to change little, so that parts
// of a sweep that see too little follow the others.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/laser_odometry/sweep_motion.hpp"
#include "perception/scan_matching/oriented_points.hpp"

namespace swiftlet::perception {

struct Sweep {
  std::vector<SweptPoint> points;
  double duration_s = 0.0;  ///< From the first beam to the last.
  SweepMotion motion;       ///< In the frame of the reference.

  /// Between the last two knots: (m/s, m/s, rad/s), axes of the reference.
  Eigen::Vector3d lastVelocity() const;
  Eigen::Vector3d firstVelocity() const;
  Eigen::Vector3d meanVelocity() const;
};

/// What is known of one end of a sweep from the sweep before or after it.
struct SweepEnd {
  common::Pose2 pose;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< (m/s, m/s, rad/s).
};

/// A motion that continues from `start` with constant velocity.
SweepMotion uniformMotion(const common::Pose2& start, const Eigen::Vector3d& velocity, double duration_s);

/// The contours of a sweep, its motion undone, in the frame of the reference.
void addSweep(const Sweep& sweep, OrientedPoints& reference);

/// Mean score of the points placed by `motion`, in [0, 1]: 1 where all lie on the reference.
double fitOf(const OrientedPoints& reference, const Sweep& sweep, const SweepMotion& motion);

/// Fits `sweep.motion`, which is the first guess. The reference must be sorted.
void fitSweep(const OrientedPoints& reference, const SweepEnd& before, const std::optional<SweepEnd>& after,
              Sweep& sweep);

}  // namespace swiftlet::perception
