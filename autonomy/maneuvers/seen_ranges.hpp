// How far the newest scan sees in each direction of the map.
#pragma once

#include <array>

#include <Eigen/Core>

#include "perception/people/people_tracker.hpp"

namespace swiftlet::autonomy {

/// Degree by degree of the bearing in `map`, the shortest beam of each; without a beam: 0.
class SeenRanges {
 public:
  SeenRanges() { ranges_m_.fill(0.0); }
  explicit SeenRanges(const perception::SeenPoints& seen);

  const Eigen::Vector2d& from_map_m() const { return from_map_m_; }
  /// In the direction of an offset from there.
  double range_m(const Eigen::Vector2d& offset_m) const;

 private:
  Eigen::Vector2d from_map_m_ = Eigen::Vector2d::Zero();
  std::array<double, 360> ranges_m_;
};

}  // namespace swiftlet::autonomy
