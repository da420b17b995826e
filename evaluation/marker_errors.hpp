// How accurate the position of a vehicle is that flies several rounds: the errors of Grzonka et al. 2012, section V-B,
// at the goals of a mission, which are markers on the floor in the paper.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "evaluation/flight_recorder.hpp"

namespace swiftlet::evaluation {

/// A marker that was reached. Errors are horizontal: the estimate minus the truth, along the axes of the true `map`.
struct MarkerVisit {
  common::Time stamp;
  Eigen::Vector2d marker_map_m = Eigen::Vector2d::Zero();  ///< The marker's place in the mission.
  /// Error of T_map_body without alignment: the paper's absolute error.
  Eigen::Vector2d estimate_error_m = Eigen::Vector2d::Zero();
  /// Error of T_odom_body when it is placed on the truth at the visit before of the same marker, or at take-off if the
  /// marker is there. This is what one loop adds if nothing is matched to the map and no graph is optimized. nullopt on
  /// the first visit elsewhere.
  std::optional<Eigen::Vector2d> open_loop_error_m;
};

/// The goals that were reached, home included, in the order of time.
std::vector<MarkerVisit> markerVisits(const std::vector<ReachedGoal>& goals);

// The worst errors of a flight, as distances; nullopt without a visit.

std::optional<double> markerError_m(const std::vector<MarkerVisit>& visits);
/// Distance between the estimates of the same place at any two visits of a marker.
std::optional<double> relocalizationError_m(const std::vector<MarkerVisit>& visits);
std::optional<double> openLoopError_m(const std::vector<MarkerVisit>& visits);

}  // namespace swiftlet::evaluation
