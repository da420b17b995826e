#include "planning/costs/cost_map.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "planning/costs/distance_transform.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::CellRect;
using common::OccupancyGrid;

/// Distance beyond the clearance at which an obstacle no longer raises the cost.
constexpr double kComfortDistance_m = 0.60;

int reachOf(double distance_m, double resolution_m) {
  return std::clamp(static_cast<int>(std::ceil(distance_m / resolution_m)), 0, kMaxReachCells);
}

}  // namespace

void CostMap::Config::describe(common::config::Fields& fields) {
  fields("comfort_weight", comfort_weight, {0, 50},
         "A metre at the clearance costs (1 + this) times as much as a metre in the open.");
}

CostMap::CostMap(const Config& config, double resolution_m) : config_(config), states_(resolution_m) {}

double CostMap::obstacleDistance_m(CellIndex c) const {
  if (!rect().contains(c)) return reach_m();
  const int squared = occupied_distance2_[static_cast<std::size_t>(indexOf(c))];
  return std::min(std::sqrt(squared) * resolution_m(), reach_m());
}

void CostMap::update(const OccupancyGrid& grid, const Footprint& footprint, const CostLayers& layers) {
  const bool moved =
      footprint.hull_radius_m != footprint_.hull_radius_m || footprint.clearance_m != footprint_.clearance_m;
  const CellRect before = rect();
  const std::vector<CellRect> changes = states_.update(grid);
  const bool all = moved || rect() != before;
  if (all) reshape(footprint);
  updateDistances(changes, all);
  applyLayers(layers);
}

void CostMap::reshape(const Footprint& footprint) {
  footprint_ = footprint;
  reach_cells_ = reachOf(footprint.radius_m() + kComfortDistance_m, resolution_m());

  const std::size_t cells = states_.all().size();
  occupied_distance2_.assign(cells, 0);
  unknown_distance2_.assign(cells, 0);
  static_cost_.assign(cells, kLethal);
  cost_.assign(cells, kLethal);

  margin_cost_.resize(static_cast<std::size_t>((reach_cells_ + 1) * (reach_cells_ + 1)) + 1);
  for (std::size_t squared = 0; squared < margin_cost_.size(); ++squared)
    margin_cost_[squared] =
        costOfMargin(std::sqrt(static_cast<double>(squared)) * resolution_m() - footprint.radius_m());
}

CostMap::Cost CostMap::costOfMargin(double margin_m) const {
  if (margin_m < 0.0) return kLethal;
  const double reach_m = this->reach_m() - footprint_.radius_m();
  if (margin_m >= reach_m) return kOpenCost;
  const double nearness = 1.0 - margin_m / reach_m;
  return static_cast<Cost>(std::lround(kOpenCost * (1.0 + config_.comfort_weight * nearness * nearness)));
}

void CostMap::updateDistances(const std::vector<CellRect>& changes, bool all) {
  const int columns = rect().width() / CellStates::kTile, rows = rect().height() / CellStates::kTile;
  std::vector<bool> dirty(static_cast<std::size_t>(columns) * rows, all);
  for (const CellRect& change : changes) {
    const int first_row = std::max(0, change.begin.y - reach_cells_) / CellStates::kTile;
    const int first_column = std::max(0, change.begin.x - reach_cells_) / CellStates::kTile;
    for (int row = first_row; row < rows && row * CellStates::kTile < change.end.y + reach_cells_; ++row)
      for (int column = first_column; column < columns && column * CellStates::kTile < change.end.x + reach_cells_;
           ++column)
        dirty[static_cast<std::size_t>(row) * columns + column] = true;
  }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      if (dirty[static_cast<std::size_t>(row) * columns + column])
        costTile(column * CellStates::kTile, row * CellStates::kTile);
}

void CostMap::costTile(int x0, int y0) {
  tileDistances(states_, x0, y0, CellState::kOccupied, reach_cells_, occupied_distance2_);
  tileDistances(states_, x0, y0, CellState::kUnknown, reachOf(footprint_.hull_radius_m, resolution_m()),
                unknown_distance2_);
  const double unknown_radius = footprint_.hull_radius_m / resolution_m();
  for (int y = y0; y < y0 + CellStates::kTile; ++y) {
    for (int x = x0; x < x0 + CellStates::kTile; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * rect().width() + x;
      const bool blind =
          states_.all()[i] == CellState::kUnknown || unknown_distance2_[i] < unknown_radius * unknown_radius;
      static_cost_[i] = blind ? kLethal : margin_cost_[static_cast<std::size_t>(occupied_distance2_[i])];
    }
  }
}

}  // namespace swiftlet::planning
