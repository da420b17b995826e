#include "evaluation/marker_errors.hpp"

#include <algorithm>

namespace swiftlet::evaluation {
namespace {

using common::Pose2;

/// Home moves by millimetres when the map is corrected; it still counts as the same place.
constexpr double kSameMarker_m = 0.02;

bool sameMarker(const Eigen::Vector2d& a_map_m, const Eigen::Vector2d& b_map_m) {
  return (a_map_m - b_map_m).norm() < kSameMarker_m;
}

/// The last visit of the same marker before `visit`. At the origin of `map` it is at least the take-off, where `map`,
/// `odom` and the vehicle coincided.
std::optional<ComparedEstimate> visitBefore(const std::vector<ReachedGoal>& goals, std::size_t visit) {
  const Eigen::Vector2d marker_map_m = goals[visit].goal_map_m;
  for (std::size_t i = visit; i-- > 0;)
    if (sameMarker(goals[i].goal_map_m, marker_map_m)) return goals[i].estimate;
  if (sameMarker(Eigen::Vector2d::Zero(), marker_map_m)) return ComparedEstimate{};
  return std::nullopt;
}

Eigen::Vector2d openLoopError(const ComparedEstimate& from, const ComparedEstimate& to) {
  const Pose2 T_from_to = from.T_odom_body.inverse() * to.T_odom_body;
  return (from.T_map_truth * T_from_to).position_m() - to.T_map_truth.position_m();
}

void raise(std::optional<double>& worst, double value) { worst = std::max(value, worst.value_or(value)); }

}  // namespace

std::vector<MarkerVisit> markerVisits(const std::vector<ReachedGoal>& goals) {
  std::vector<MarkerVisit> visits;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const ComparedEstimate& estimate = goals[i].estimate;
    MarkerVisit visit{
        goals[i].stamp, goals[i].goal_map_m, estimate.T_map_body.position_m() - estimate.T_map_truth.position_m(), {}};
    if (const auto before = visitBefore(goals, i)) visit.open_loop_error_m = openLoopError(*before, estimate);
    visits.push_back(visit);
  }
  return visits;
}

std::optional<double> markerError_m(const std::vector<MarkerVisit>& visits) {
  std::optional<double> worst;
  for (const MarkerVisit& visit : visits) raise(worst, visit.estimate_error_m.norm());
  return worst;
}

std::optional<double> relocalizationError_m(const std::vector<MarkerVisit>& visits) {
  std::optional<double> worst;
  for (auto a = visits.begin(); a != visits.end(); ++a)
    for (auto b = std::next(a); b != visits.end(); ++b)
      if (sameMarker(a->marker_map_m, b->marker_map_m))
        raise(worst, (a->estimate_error_m - b->estimate_error_m).norm());
  return worst;
}

std::optional<double> openLoopError_m(const std::vector<MarkerVisit>& visits) {
  std::optional<double> worst;
  for (const MarkerVisit& visit : visits)
    if (visit.open_loop_error_m) raise(worst, visit.open_loop_error_m->norm());
  return worst;
}

}  // namespace swiftlet::evaluation
