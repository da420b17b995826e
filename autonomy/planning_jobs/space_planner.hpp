// Paths at any height: where no path leads to a goal at the height of flight, the vehicle flies through windows and
// gaps, below beams and over furniture, wherever the 3D map shows room for the hull. A laser alone cannot see that
// room.
//
//   FlightSpace --> planBySampling, with the full clearance or else half --> changes of height near where they are
//   needed
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "autonomy/planning_jobs/flight_space.hpp"
#include "autonomy/planning_jobs/planning_request.hpp"
#include "planning/clearance/hull_space.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {

/// What the last plan in space was made with. Immutable once published.
struct SpaceMaps {
  planning::HullSpace hull;
  /// At the height at which the vehicle was, `here_height_m`, if that was not the height of flight.
  std::optional<planning::CostMap> here;
  double here_height_m = 0.0;
};

/// One job at a time. The answers depend only on the calls so far.
class SpacePlanner {
 public:
  /// Not `enabled`: there is never a path.
  SpacePlanner(bool enabled, const planning::CostMap::Config& costs, double resolution_m, double hull_height_m)
      : enabled_(enabled), costs_(costs), resolution_m_(resolution_m), space_(hull_height_m) {}

  /// The request has a 3D map, and a grid of the height of flight with what the camera sees there, of which `grid` are
  /// the states. A path has Path::heights_m. It ends at the height of flight where the hull may be there, otherwise at
  /// the nearest height at which it may.
  tl::expected<planning::Path, planning::PlanFailure> plan(const PlanningRequest& request, const GoalRequest& goal,
                                                           const planning::CellStates& grid,
                                                           const planning::CostLayers& layers);
  /// Of the last call of plan() that found a 3D map around; null before.
  const std::shared_ptr<const SpaceMaps>& maps() const { return maps_; }

 private:
  void publish(const PlanningRequest& request, const FlightHeights& heights, const planning::CostLayers& layers);
  std::optional<Eigen::Vector3d> goalPlace(const GoalRequest& goal) const;
  planning::Path pathThrough(std::vector<Eigen::Vector3d> places_map_m, const FlightHeights& heights) const;
  bool isFree(const std::vector<Eigen::Vector3d>& places_map_m) const;
  std::vector<Eigen::Vector3d> centred(std::vector<Eigen::Vector3d> places_map_m, double cruise_m) const;
  std::vector<Eigen::Vector3d> withLateChanges(const std::vector<Eigen::Vector3d>& places_map_m, double cruise_m) const;

  bool enabled_;
  planning::CostMap::Config costs_;
  double resolution_m_;
  FlightSpace space_;
  std::shared_ptr<const SpaceMaps> maps_;
  std::uint64_t plans_ = 0;  ///< Each plan draws other samples.
};

}  // namespace swiftlet::autonomy
