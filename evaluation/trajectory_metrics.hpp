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
  common::Time stamp;  ///< Stamp of the estimate.
  common::Pose3 estimate;
  common::Pose3 truth;
};

/// Pairs each estimate with the true pose nearest in time, if it is within `max_difference`. If two estimates have the
/// same nearest true pose, the nearer estimate gets it. Both trajectories are ordered by time.
std::vector<PosePair> associate(const common::Trajectory& estimate, const common::Trajectory& truth,
                                common::Duration max_difference = common::Duration::fromMilliseconds(10));

enum class Alignment {
  kNone,       ///< Both are in one frame already.
  kFirstPose,  ///< The first poses coincide.
  kPlanar,     ///< Least squares over x, y and yaw; z is shifted by the mean.
  kSpatial,    ///< Least squares over all six degrees of freedom. No scale.
};

/// T_truth_estimate. nullopt if there are too few pairs, or if their points do not determine the rotation: all at one
/// point (planar) or on one line (spatial).
std::optional<common::Pose3> align(const std::vector<PosePair>& pairs, Alignment alignment);

/// The factor by which the estimate is multiplied to fit best when it is also aligned in this mode (planar or spatial;
/// Umeyama 1991, eq. 42). It is for estimates without absolute scale, such as those of one camera. nullopt if `align`
/// fails, or if no positive scale fits: heights that are upside down can outweigh the rest of a planar alignment.
std::optional<double> bestScale(const std::vector<PosePair>& pairs, Alignment alignment);
/// The pairs with the positions of the estimate multiplied by `scale`.
std::vector<PosePair> scaled(std::vector<PosePair> pairs, double scale);

/// The errors of the positions after alignment, in metres; nullopt if `align` fails.
struct AbsoluteError {
  common::Pose3 T_truth_estimate;
  Statistics translation_m;
  Statistics rotation_rad;
};
std::optional<AbsoluteError> absoluteTrajectoryError(const std::vector<PosePair>& pairs, Alignment alignment);

/// The stretch over which a relative error is taken: from each pose to the first one at least this far on, within
/// rounding.
struct Stretch {
  enum class Unit { kFrames, kSeconds, kMetres };  ///< Metres along the true path.
  Unit unit = Unit::kFrames;
  double length = 1.0;
};

/// The drift over stretches, from every pose that starts one; independent of any alignment.
struct RelativeError {
  Statistics translation_m;
  Statistics rotation_rad;
};
RelativeError relativePoseError(const std::vector<PosePair>& pairs, const Stretch& stretch);

}  // namespace swiftlet::evaluation
