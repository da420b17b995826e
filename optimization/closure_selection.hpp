// Which loop closures of a pose graph agree with each other, and which are wrong.
//
//   all closures -> a truncation that narrows: what agreed best, and what agreed last --+
//   odometry -> the closures closest to it ---------------------------------------------+-> remove and take back until
//   nothing changes -> the cheapest of the three -> enough agree? -> kept and refused
//
// Truncated least squares by graduation (Yang, Antonante, Tzoumas and Carlone, Graduated Non-Convexity for Robust
// Spatial Perception, RA-L 2020). There the truncation is known and the cost is made convex at first; here the scale of
// the errors is not known, and it is the truncation that narrows. What is truncated is not the error of a closure but
// its squared innovation, which is what the sum of squares falls by without it: a closure bends a long chain of
// odometry until its own error is small.
//
// Information matrices of real graphs are often wrong by a common factor. It is estimated from the innovations
// themselves, and the thresholds are relative to it. Odometry is always kept.
#pragma once

#include <cstddef>
#include <vector>

#include "optimization/weighted_graph.hpp"

namespace swiftlet::optimization {

struct ClosureSelection {
  std::vector<bool> kept;  ///< Of each edge. True for odometry.
  /// Of each edge, the innovation against the kept ones: root mean square over its degrees of freedom, in standard
  /// deviations after multiplication of the covariances by the variance factor. 0 for odometry.
  std::vector<double> sigmas;
  /// The factor by which the covariances of the closures' innovations exceed those that the information gives.
  double variance_factor = 1.0;
  std::size_t closures = 0;
  std::size_t refused = 0;
  int iterations = 0;  ///< Number of weightings for which the graph was optimized.
  /// False: as many were refused as agree, or those that were refused agree as well, or those that are kept are three
  /// times as far off as their information says.
  bool sure = true;
};

/// The graph's poses are the optimum for the kept edges afterwards.
ClosureSelection selectClosures(WeightedGraph& graph);

/// For a graph whose poses are the optimum for all edges: refuses as selectClosures() does, but only where the
/// errors are impossible: one closure is off by 25 standard deviations, or all together are off by more than the
/// information says, and one stands out. Elsewhere it refuses no closure, and takes the time of one evaluation.
ClosureSelection contradictedClosures(WeightedGraph& graph);

}  // namespace swiftlet::optimization
