// Judges a finished map by itself: stretches of the track that saw the same place at different times must agree in what
// is free. Walls that are drawn twice, or a place that is laid onto another, contradict each other even where every
// single match was good (docs/decisions/slam.md#026).
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "perception/slam2d/free_space_violation.hpp"

namespace swiftlet::perception {

/// Two stretches of key scans that saw the same place.
struct SeenTwice {
  std::size_t first_key = 0, other_key = 0;  ///< The first key scan of each, by index.
  /// Free-space violation between the two beyond that within each, in [0, 1]; 0 where they agree.
  double violation = 0.0;
  Eigen::Vector2d at_map_m = Eigen::Vector2d::Zero();  ///< Between the middles of the two.
};

struct MapJudgement {
  static constexpr std::size_t kStretch = 12;  ///< Key scans: fewer see too little of a place, more are spread widely.

  std::vector<SeenTwice> agreeing;
  std::vector<SeenTwice> contradicting;  ///< The worst first.

  std::size_t pairs() const { return agreeing.size() + contradicting.size(); }
  /// Mean violation over all pairs; 0 without pairs.
  double violation() const;
};

/// Judges the key scans of a whole track, in the order in which they were taken, at their final poses. Points beyond
/// `max_range_m` from their own scan are left out. Thread-safe.
MapJudgement judgeMap(const std::vector<PlacedScan>& keys, double max_range_m);

}  // namespace swiftlet::perception
