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
/// Greatest reach, which bounds the memory of very fine maps' tables.
constexpr int kMaxReachCells = 63;

int reachOf(double distance_m, double resolution_m) {
  return std::clamp(static_cast<int>(std::ceil(distance_m / resolution_m)), 1, kMaxReachCells);
}

}  // namespace

void CostMap::Config::describe(common::config::Fields& fields) {
  fields("comfort_weight", comfort_weight, {0, 50},
         "A metre at the clearance costs (1 + this) times as much as a metre in the open.");
}

CostMap::CostMap(const Config& config, double resolution_m) : config_(config), states_(resolution_m) {}

double CostMap::obstacleDistance_m(CellIndex c) const {
  if (!rect().contains(c)) return reach_m();
  const int squared = occupied_.squared({c.x - rect().begin.x, 0, c.y - rect().begin.y});
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
  static_cost_.assign(cells, kOpenCost);
  cost_.assign(cells, kLethal);
  if (cells > 0) {
    const common::VoxelIndex size{rect().width(), 1, rect().height()};
    occupied_ = DistanceField(size, reach_cells_);
    unknown_ = DistanceField(size, reachOf(footprint.hull_radius_m, resolution_m()));
  }

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
  if (rect().empty()) return;
  std::vector<CellBox> boxes;
  if (all) boxes.push_back({{0, 0, 0}, {rect().width(), 1, rect().height()}});
  for (const CellRect& change : changes)
    boxes.push_back({{change.begin.x, 0, change.begin.y}, {change.end.x, 1, change.end.y}});
  for (const CellState which : {CellState::kOccupied, CellState::kUnknown}) {
    DistanceField& field = which == CellState::kOccupied ? occupied_ : unknown_;
    const auto read = [&](common::VoxelIndex first, std::span<std::uint8_t, DistanceField::kRow> is) {
      const auto row = states_.all().begin() + static_cast<std::ptrdiff_t>(first.z) * rect().width() + first.x;
      std::transform(row, row + is.size(), is.begin(), [which](CellState state) { return state == which; });
    };
    for (const CellBox& changed : field.update(boxes, read)) costBox(changed);
  }
}

void CostMap::costBox(const CellBox& box) {
  const double unknown_radius = footprint_.hull_radius_m / resolution_m();
  for (int y = box.begin.z; y < box.end.z; ++y) {
    for (int x = box.begin.x; x < box.end.x; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * rect().width() + x;
      const bool blind =
          states_.all()[i] == CellState::kUnknown || unknown_.squared({x, 0, y}) < unknown_radius * unknown_radius;
      static_cost_[i] = blind ? kLethal : margin_cost_[static_cast<std::size_t>(occupied_.squared({x, 0, y}))];
    }
  }
}

}  // namespace swiftlet::planning
