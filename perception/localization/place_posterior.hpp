// Refines the places found by a coarse search on the fine likelihood field, and computes how probable each of them is.
#pragma once

#include <vector>

#include "perception/localization/global_search.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

struct LikelyPlace {
  common::Pose2 T_grid_points;
  double fit = 0.0;             ///< Mean field value at the points, in [0, 1].
  double log_likelihood = 0.0;  ///< In nats, relative to points that are far from every wall.
  double probability = 0.0;     ///< Relative to the other places.
  double explained = 0.0;       ///< Share of the points on known cells that have a wall nearby.
};

/// Log-likelihood of points at a pose. `point_weight` is the weight of one point; it is less than 1 because
/// neighbouring points are not independent.
double logLikelihood(const MapField& map, const std::vector<Eigen::Vector2f>& points_m,
                     const common::Pose2& T_grid_points, double point_weight);

struct PlaceDistinction {
  double distance_m = 0.5;
  double turn_rad = 0.26;
  bool same(const common::Pose2& a, const common::Pose2& b) const;
};

/// Moves each place to the best pose nearby and merges those that end up together. Most probable first.
std::vector<LikelyPlace> likelyPlaces(Instructions instructions, const MapField& map,
                                      const std::vector<FittingPlace>& found,
                                      const std::vector<Eigen::Vector2f>& points_m, double point_weight,
                                      double tolerance_m, const PlaceDistinction& distinction);

}  // namespace swiftlet::perception
