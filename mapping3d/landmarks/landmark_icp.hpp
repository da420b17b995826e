// Iterative closest point of a frame's features to landmarks, by the Mahalanobis distance.
//
// Source: Saeedi et al., section III-C.3 and line 3 of Algorithm 1, after I. Dryanovski, R. G. Valenti, J. Xiao, "Fast
// visual odometry and mapping from RGB-D data", ICRA 2013. The pose minimizes the Mahalanobis distances by
// Gauss-Newton, which also gives its covariance.
#pragma once

#include <span>
#include <vector>

#include "mapping3d/landmarks/landmark_model.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

/// A feature and the landmark that it shows, as indices.
struct LandmarkMatch {
  std::size_t feature = 0;
  std::size_t landmark = 0;
};

struct ModelMatch {
  /// `points` counts the matches, `measured` the features that have a landmark within reach of the first search, and
  /// `agreement` is the share of those that match. Of the picture itself nothing is known: `overlap` is 0.
  Alignment fit;
  std::vector<LandmarkMatch> matches;  ///< Of the last iteration; neither has two. In the order of the features.
};

/// Starts at the prior's pose; without information in the prior, the features alone determine the pose. The
/// association of the first iterations reaches 15 cm, that of the last ones the 99 % of the covariances.
ModelMatch matchToModel(std::span<const vision::Feature> features, std::span<const Landmark> landmarks,
                        const PosePrior& prior);

}  // namespace swiftlet::mapping3d
