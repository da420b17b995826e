// Paths below what hangs over them: where the voxels of the camera show room for the hull at a lower height, the
// vehicle flies there, and comes back up behind it. A laser alone cannot see that room.
//
//   voxels, grid at the height of flight --> two cost maps, one lower --> planAtTwoHeights
#pragma once

#include <memory>
#include <optional>

#include <tl/expected.hpp>

#include "autonomy/planning_jobs/planning_request.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/search/two_heights.hpp"

namespace swiftlet::autonomy {

/// One job at a time. Each call tries one height: that of the present plan, or that which the last call
/// succeeded with, or the next lower one.
class LowerPlanner {
 public:
  /// Not `enabled`: there is never a path.
  LowerPlanner(bool enabled, const planning::CostMap::Config& costs, double resolution_m, double hull_height_m);

  /// The request has a 3D map, and a grid of the height of flight with what the camera sees there.
  tl::expected<planning::Path, planning::PlanFailure> plan(const PlanningRequest& request, const GoalRequest& goal,
                                                           const planning::CostLayers& layers);
  /// The cost maps of the last call of plan(); null before the first.
  std::shared_ptr<const planning::TwoHeights> maps() const { return maps_; }

 private:
  std::optional<double> chooseHeight(const FlightHeights& height) const;
  void update(const PlanningRequest& request, double cruise_m, double lower_m, const planning::CostLayers& layers);

  bool enabled_;
  double half_hull_m_;
  planning::CostMap upper_, lower_;
  std::shared_ptr<const planning::TwoHeights> maps_;
  int tried_ = 0;  ///< Steps below the first height that is tried.
};

}  // namespace swiftlet::autonomy
