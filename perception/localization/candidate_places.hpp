// The places where the vehicle may be, kept from one search of the whole map to the next. Private to localization.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/geometry.hpp"
#include "common/localization.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

/// A value. Between two searches the places move with the odometry.
class CandidatePlaces {
 public:
  void clear() { places_.clear(); }

  /// `likely`, most probable first, are poses of points whose frame has the pose `T_odom_points`.
  void set(const std::vector<LikelyPlace>& likely, const common::Pose2& T_odom_points) {
    places_.assign(likely.begin(), likely.begin() + static_cast<std::ptrdiff_t>(std::min(likely.size(), kMost)));
    T_points_odom_ = T_odom_points.inverse();
  }

  /// The poses of a body at `T_odom_body`.
  std::vector<common::PlaceCandidate> at(const common::Pose2& T_map_grid, const common::Pose2& T_odom_body) const {
    std::vector<common::PlaceCandidate> candidates;
    for (const LikelyPlace& place : places_)
      candidates.push_back({T_map_grid * place.T_grid_points * T_points_odom_ * T_odom_body, place.probability});
    return candidates;
  }

 private:
  /// More than an operator can distinguish; hundreds may fit in a large building, nearly all of them unlikely.
  static constexpr std::size_t kMost = 20;

  std::vector<LikelyPlace> places_;
  common::Pose2 T_points_odom_;
};

}  // namespace swiftlet::perception
