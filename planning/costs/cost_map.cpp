#include "planning/costs/cost_map.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::CellRect;
using common::OccupancyGrid;

/// Distance beyond the clearance at which an obstacle no longer raises the cost.
constexpr double kComfortDistance_m = 0.60;

}  // namespace

void CostMap::Config::describe(common::config::Fields& fields) {
  fields("comfort_weight", comfort_weight, {0, 50},
         "A metre at the clearance costs (1 + this) times as much as a metre in the open.");
}

CostMap::CostMap(const Config& config, double resolution_m)
    : config_(config), clearance_(Clearance::ofPlane(resolution_m)) {}

void CostMap::update(const OccupancyGrid& grid, const Footprint& footprint, const CostLayers& layers) {
  const bool moved =
      footprint.hull_radius_m != footprint_.hull_radius_m || footprint.clearance_m != footprint_.clearance_m;
  if (moved) {
    footprint_ = footprint;
    clearance_ = Clearance::ofPlane(resolution_m(), {footprint.radius_m() + kComfortDistance_m, footprint.radius_m()});
  }
  const CellRect before = rect();
  const std::vector<CellBox> changes = clearance_.update(grid, layers.discs, layers.keep_out);
  if (moved || rect() != before) reshape();
  for (const CellBox& changed : changes) costBox(changed);
  applyLayers(layers);
}

void CostMap::reshape() {
  const std::size_t cells = states().all().size();
  static_cost_.assign(cells, kOpenCost);
  cost_.assign(cells, kLethal);
  const auto reach_cells = static_cast<std::size_t>(std::lround(reach_m() / resolution_m()));
  margin_cost_.resize((reach_cells + 1) * (reach_cells + 1) + 1);
  for (std::size_t squared = 0; squared < margin_cost_.size(); ++squared)
    margin_cost_[squared] =
        costOfMargin(std::sqrt(static_cast<double>(squared)) * resolution_m() - footprint_.radius_m());
}

CostMap::Cost CostMap::costOfMargin(double margin_m) const {
  if (margin_m < 0.0) return kLethal;
  const double reach_m = this->reach_m() - footprint_.radius_m();
  if (margin_m >= reach_m) return kOpenCost;
  const double nearness = 1.0 - margin_m / reach_m;
  return static_cast<Cost>(std::lround(kOpenCost * (1.0 + config_.comfort_weight * nearness * nearness)));
}

void CostMap::costBox(const CellBox& box) {
  const double unknown_radius = footprint_.hull_radius_m / resolution_m();
  for (int y = box.begin.z; y < box.end.z; ++y) {
    for (int x = box.begin.x; x < box.end.x; ++x) {
      const CellIndex cell{rect().begin.x + x, rect().begin.y + y};
      const auto i = static_cast<std::size_t>(indexOf(cell));
      const bool blind = states()[static_cast<int>(i)] == CellState::kUnknown ||
                         clearance_.squaredCells(cell, Against::kUnseen) < unknown_radius * unknown_radius;
      static_cost_[i] =
          blind ? kLethal : margin_cost_[static_cast<std::size_t>(clearance_.squaredCells(cell, Against::kObstacles))];
    }
  }
}

bool isFree(const CostMap& map, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) {
  const Eigen::Vector3d from(from_map_m.x(), from_map_m.y(), 0.0), to(to_map_m.x(), to_map_m.y(), 0.0);
  return map.clearance().isFree(from, to, map.footprint().radius_m(), Against::kThings) &&
         map.clearance().isFree(from, to, map.footprint().hull_radius_m, Against::kUnseen);
}

}  // namespace swiftlet::planning
