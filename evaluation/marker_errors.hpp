// How well a vehicle that flies round and round knows where it is: the three errors of Grzonka et al. 2012, section
// V-B, at the goals of a mission, there markers on the floor.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "evaluation/flight_recorder.hpp"

namespace swiftlet::evaluation {

/// A marker that was reached. Errors are horizontal, the estimate less the truth, with the axes of the true `map`.
struct MarkerVisit {
  common::Time stamp;
  Eigen::Vector2d marker_map_m = Eigen::Vector2d::Zero();  ///< As the mission has it.
  /// Of T_map_body, nothing aligned: the paper's absolute error.
  Eigen::Vector2d estimate_error_m = Eigen::Vector2d::Zero();
  /// Of T_odom_body, put on the truth at the visit before of the same marker, at take-off where the marker is there:
  /// what one loop adds where nothing is matched to the map, nor a graph optimized. None on the first visit elsewhere.
  std::optional<Eigen::Vector2d> open_loop_error_m;
};

/// The goals that were reached, home with them, in the order of time.
std::vector<MarkerVisit> markerVisits(const std::vector<ReachedGoal>& goals);

// The worst of a flight, as distances; none where there was nothing to measure.

std::optional<double> markerError_m(const std::vector<MarkerVisit>& visits);
/// Between any two visits of the same marker: how far apart the same place was estimated.
std::optional<double> relocalizationError_m(const std::vector<MarkerVisit>& visits);
std::optional<double> openLoopError_m(const std::vector<MarkerVisit>& visits);

}  // namespace swiftlet::evaluation
