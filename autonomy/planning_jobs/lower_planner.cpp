#include "autonomy/planning_jobs/lower_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "autonomy/planning_jobs/voxel_columns.hpp"
#include "common/goal.hpp"
#include "planning/search/admission.hpp"
#include "planning/search/goal_map.hpp"

namespace swiftlet::autonomy {
namespace {

/// A little farther than a depth camera sees.
constexpr double kLowerReach_m = 6.0;
/// Least height of a path that leads below what the camera sees (docs/decisions/planning.md#082).
constexpr double kLeastHeight_m = 0.5;
/// Free height below the middle of the hull; more than what lifts the path over a surface (control.clearance.least_m).
constexpr double kAirBelow_m = 0.45;
/// Free height that the hull needs above itself, as it rises and sinks.
constexpr double kAirAround_m = 0.15;
/// Heights are tried in these steps, from the height of flight down.
constexpr double kHeightStep_m = 0.1;
/// Metres of path that a change of height is worth.
constexpr double kChangeCost_m = 1.0;

using common::CellIndex;
using common::OccupancyGrid;
namespace occupancy = common::occupancy;

/// Where the camera saw free space, it is as certain as by some beams of the laser.
constexpr occupancy::Cell kSeenFree = -20;

/// Two grids of the same extent: what is known at the height of flight, and at the lower one.
struct TwoGrids {
  OccupancyGrid upper, lower;
};

TwoGrids gridsOf(const OccupancyGrid& grid, const VoxelColumns& upper_columns, const VoxelColumns& lower_columns,
                 const Eigen::Vector2d& around_map_m) {
  TwoGrids grids{grid, common::makeOccupancyGrid(grid.resolution_m())};
  const common::CellRect extent = grid.extent();
  const CellIndex center = grid.cellAt(around_map_m);
  const int reach = static_cast<int>(kLowerReach_m / grid.resolution_m());
  const CellIndex low{center.x - reach, center.y - reach}, high{center.x + reach, center.y + reach};
  const auto allocate = [](OccupancyGrid& in, CellIndex cell) { in.set(cell, in.at(cell)); };
  for (OccupancyGrid* in : {&grids.upper, &grids.lower}) {
    allocate(*in, low);
    allocate(*in, high);
    if (extent.empty()) continue;
    allocate(*in, extent.begin);
    allocate(*in, {extent.end.x - 1, extent.end.y - 1});
  }
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const CellIndex cell{x, y};
      const Eigen::Vector2d place_map_m = grid.centerOf(cell);
      const ColumnState state = lower_columns.at(place_map_m);
      if (state == ColumnState::kFree) grids.lower.set(cell, kSeenFree);
      if (state == ColumnState::kOccupied) grids.lower.set(cell, occupancy::kMaxSteps);
      if (occupancy::isUnknown(grid.at(cell)) && upper_columns.at(place_map_m) == ColumnState::kFree)
        grids.upper.set(cell, kSeenFree);
    }
  return grids;
}

}  // namespace

LowerPlanner::LowerPlanner(bool enabled, const planning::CostMap::Config& costs, double resolution_m,
                           double hull_height_m)
    : enabled_(enabled), half_hull_m_(0.5 * hull_height_m), upper_(costs, resolution_m), lower_(costs, resolution_m) {}

/// The first height that differs is one hull below.
std::optional<double> LowerPlanner::chooseHeight(const FlightHeights& height) const {
  if (height.lowered_m) return height.lowered_m;
  const double highest_m = height.cruise_m - 2.0 * half_hull_m_;
  if (highest_m < kLeastHeight_m) return std::nullopt;
  const int steps = 1 + static_cast<int>((highest_m - kLeastHeight_m) / kHeightStep_m + 1e-9);
  return highest_m - (tried_ % steps) * kHeightStep_m;
}

void LowerPlanner::update(const PlanningRequest& request, double cruise_m, double lower_m,
                          const planning::CostLayers& layers) {
  const Eigen::Vector2d here_map_m = request.T_map_body.position_m();
  const double around_m = half_hull_m_ + kAirAround_m;
  const VoxelColumns upper(*request.map3d, cruise_m - around_m, cruise_m + around_m, here_map_m, kLowerReach_m);
  const VoxelColumns lower(*request.map3d, lower_m - kAirBelow_m, lower_m + around_m, here_map_m, kLowerReach_m);
  const TwoGrids grids = gridsOf(*request.grid, upper, lower, here_map_m);
  upper_.update(grids.upper, request.footprint, layers);
  lower_.update(grids.lower, request.footprint, layers);
  upper_.name(request.names);
  maps_ = std::make_shared<const planning::TwoHeights>(planning::TwoHeights{upper_, lower_, lower_m});
}

tl::expected<planning::Path, planning::PlanFailure> LowerPlanner::plan(const PlanningRequest& request,
                                                                       const GoalRequest& goal,
                                                                       const planning::CostLayers& layers) {
  const auto lower_m = enabled_ ? chooseHeight(goal.height) : std::nullopt;
  if (!lower_m) return tl::make_unexpected(planning::PlanFailure{});
  update(request, goal.height.cruise_m, *lower_m, layers);
  planning::PlanFailure failure;
  for (const planning::CostMap* map : {&maps_->upper, &maps_->lower}) {
    const planning::CostGoalMap goals(*map);
    const auto place = common::judgeGoal(
        {goal.goal_map_m, std::nullopt, goal.tolerance_m, request.footprint.clearance_m, goal.shift_m, request.names},
        {}, &goals);
    if (!place) {
      failure = planning::failureOf(place.error());
      continue;
    }
    auto path = planAtTwoHeights(*maps_, request.T_map_body.position_m(), *place, goal.height.isLower(), kChangeCost_m);
    if (path) return path;
    failure = path.error();
  }
  ++tried_;
  return tl::make_unexpected(std::move(failure));
}

}  // namespace swiftlet::autonomy
