#include "autonomy/planning_jobs/lower_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "autonomy/planning_jobs/voxel_columns.hpp"
#include "common/config_fields.hpp"
#include "common/goal.hpp"
#include "planning/search/admission.hpp"
#include "planning/search/goal_map.hpp"

namespace swiftlet::autonomy {
namespace {

/// A little farther than a depth camera sees.
constexpr double kLowerReach_m = 6.0;

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

void LowerFlightConfig::describe(common::config::Fields& fields) {
  fields("enabled", enabled, "Whether paths may lead below things that the camera sees at the height of flight.");
}

LowerPlanner::LowerPlanner(const LowerFlightConfig& config, const planning::CostMap::Config& costs, double resolution_m,
                           double hull_height_m)
    : config_(config), half_hull_m_(0.5 * hull_height_m), upper_(costs, resolution_m), lower_(costs, resolution_m) {}

/// The first height that differs is one hull below.
std::optional<double> LowerPlanner::chooseHeight(const FlightHeights& height) const {
  if (height.lowered_m) return height.lowered_m;
  const double highest_m = height.cruise_m - 2.0 * half_hull_m_;
  if (highest_m < config_.least_height_m) return std::nullopt;
  const int steps = 1 + static_cast<int>((highest_m - config_.least_height_m) / config_.step_m + 1e-9);
  return highest_m - (tried_ % steps) * config_.step_m;
}

void LowerPlanner::update(const LowerQuestion& question, double lower_m) {
  const double around_m = half_hull_m_ + config_.air_around_m, cruise_m = question.height.cruise_m;
  const VoxelColumns upper(question.map3d, cruise_m - around_m, cruise_m + around_m, question.start_map_m,
                           kLowerReach_m);
  const VoxelColumns lower(question.map3d, lower_m - config_.air_below_m, lower_m + around_m, question.start_map_m,
                           kLowerReach_m);
  const TwoGrids grids = gridsOf(question.grid, upper, lower, question.start_map_m);
  upper_.update(grids.upper, question.footprint, question.layers);
  lower_.update(grids.lower, question.footprint, question.layers);
  upper_.name(question.names);
  maps_ = std::make_shared<const planning::TwoHeights>(planning::TwoHeights{upper_, lower_, lower_m});
}

tl::expected<planning::Path, planning::PlanFailure> LowerPlanner::plan(const LowerQuestion& question) {
  const auto lower_m = config_.enabled ? chooseHeight(question.height) : std::nullopt;
  if (!lower_m) return tl::make_unexpected(planning::PlanFailure{});
  update(question, *lower_m);
  planning::PlanFailure failure;
  for (const planning::CostMap* map : {&maps_->upper, &maps_->lower}) {
    const planning::CostGoalMap goals(*map);
    const auto place = common::judgeGoal({question.goal_map_m, std::nullopt, question.tolerance_m,
                                          question.footprint.clearance_m, question.shift_m, question.names},
                                         {}, &goals);
    if (!place) {
      failure = planning::failureOf(place.error());
      continue;
    }
    auto path =
        planAtTwoHeights(*maps_, question.start_map_m, *place, question.height.isLower(), config_.change_cost_m);
    if (path) return path;
    failure = path.error();
  }
  ++tried_;
  return tl::make_unexpected(std::move(failure));
}

}  // namespace swiftlet::autonomy
