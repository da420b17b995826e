// Paths below what hangs over them: where the voxels of the camera show room for the hull at a lower height, the
// vehicle flies there, and comes back up behind it. A laser alone cannot see that room.
//
//   voxels, grid at the height of flight --> two cost maps, one lower --> planAtTwoHeights
#pragma once

#include <memory>
#include <optional>

#include <tl/expected.hpp>

#include "autonomy/planning_jobs/lower_flight_config.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/world/map3d_layer.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/search/two_heights.hpp"

namespace swiftlet::autonomy {

/// The heights at the time of a path request.
struct FlightHeights {
  double cruise_m = 1.0;            ///< The height of flight, over the take-off floor.
  double reference_m = 1.0;         ///< Reference height of the controller.
  std::optional<double> lowered_m;  ///< The lower height of the plan that is flown; nullopt without such a plan.

  /// The vehicle is nearer to the lower height.
  bool isLower() const { return lowered_m && reference_m < 0.5 * (cruise_m + *lowered_m); }
};

/// References are read during the call only.
struct LowerQuestion {
  const common::Map3dLayer& map3d;
  const common::OccupancyGrid& grid;  ///< Of the height of flight, with what the camera sees there.
  planning::Footprint footprint;
  const planning::CostLayers& layers;
  const common::PlaceNames& names;
  FlightHeights height;
  Eigen::Vector2d start_map_m;
  Eigen::Vector2d goal_map_m;
  double tolerance_m = 0.0, shift_m = 0.0;  ///< As those of a GoalRequest.
};

/// One job at a time. Each call tries one height: that of the present plan, or that which the last call
/// succeeded with, or the next lower one.
class LowerPlanner {
 public:
  LowerPlanner(const LowerFlightConfig& config, const planning::CostMap::Config& costs, double resolution_m,
               double hull_height_m);

  tl::expected<planning::Path, planning::PlanFailure> plan(const LowerQuestion& question);
  /// The cost maps of the last call of plan(); null before the first.
  std::shared_ptr<const planning::TwoHeights> maps() const { return maps_; }

 private:
  std::optional<double> chooseHeight(const FlightHeights& height) const;
  void update(const LowerQuestion& question, double lower_m);

  LowerFlightConfig config_;
  double half_hull_m_;
  planning::CostMap upper_, lower_;
  std::shared_ptr<const planning::TwoHeights> maps_;
  int tried_ = 0;  ///< Steps below the first height that is tried.
};

}  // namespace swiftlet::autonomy
