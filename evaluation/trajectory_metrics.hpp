// How well an estimated trajectory follows the true one, by the published metrics.
// Sources: Sturm et al., "A Benchmark for the Evaluation of RGB-D SLAM Systems", IROS 2012 (absolute trajectory error,
// relative pose error); Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
// PAMI 1991 (alignment).
#pragma once

#include <optional>
#include <vector>

#include "common/trajectory.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {

/// An estimated and a true pose of the same time.
struct PosePair {
  common::Time stamp;  ///< Of the estimate.
  common::Pose3 estimate;
  common::Pose3 truth;
};

/// Each estimate with the true pose nearest in time, if it is within `max_difference`; of two estimates that want one
/// true pose, the nearer gets it. Both trajectories are ordered by time.
std::vector<PosePair> associate(const common::Trajectory& estimate, const common::Trajectory& truth,
                                common::Duration max_difference = common::Duration::fromMilliseconds(10));

enum class Alignment {
  kNone,       ///< Both are in one frame already.
  kFirstPose,  ///< The first poses coincide.
  kPlanar,     ///< Least squares over x, y and yaw; z is shifted by the mean.
  kSpatial,    ///< Least squares over all six degrees of freedom. No scale.
};

/// T_truth_estimate. None when there are too few pairs, or their points lie so that the rotation is not determined: on
/// one point (planar) or on one line (spatial).
std::optional<common::Pose3> align(const std::vector<PosePair>& pairs, Alignment alignment);

/// By what the estimate is multiplied to fit best when it is also aligned so (planar or spatial; Umeyama 1991, eq. 42):
/// for estimates that do not know how large the world is, as those of one camera. None where `align` gives none, or
/// where no positive scale fits: heights that are upside down can outweigh the rest of a planar alignment.
std::optional<double> bestScale(const std::vector<PosePair>& pairs, Alignment alignment);
/// The pairs with the estimate's positions multiplied.
std::vector<PosePair> scaled(std::vector<PosePair> pairs, double scale);

/// The errors of the positions after alignment, in metres; none where `align` gives none.
struct AbsoluteError {
  common::Pose3 T_truth_estimate;
  Statistics translation_m;
  Statistics rotation_rad;
};
std::optional<AbsoluteError> absoluteTrajectoryError(const std::vector<PosePair>& pairs, Alignment alignment);

/// Over which stretch a relative error is taken: from each pose to the first one at least this far on, but for what
/// rounding may take away.
struct Stretch {
  enum class Unit { kFrames, kSeconds, kMetres };  ///< Metres along the true path.
  Unit unit = Unit::kFrames;
  double length = 1.0;
};

/// The drift over stretches, from every pose that has one; independent of any alignment.
struct RelativeError {
  Statistics translation_m;
  Statistics rotation_rad;
};
RelativeError relativePoseError(const std::vector<PosePair>& pairs, const Stretch& stretch);

}  // namespace swiftlet::evaluation
