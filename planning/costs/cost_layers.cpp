// The layers over the grid of a cost map: flown paths, discs, keep-out zones, steps of the surface.
#include <algorithm>
#include <cmath>

#include "common/segment.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

void CostMap::applyLayers(const CostLayers& layers) {
  cost_ = static_cost_;
  for (std::size_t i = 1; i < layers.flown_map_m.size(); ++i)
    applyFlown(layers.flown_map_m[i - 1], layers.flown_map_m[i]);
  closeBorder();
  by_disc_.assign(layers.discs.empty() ? 0 : cost_.size(), 0);
  for (const common::Disc& disc : layers.discs) applyDisc(disc);
  kept_out_.assign(layers.keep_out.empty() ? 0 : cost_.size(), 0);
  for (const common::Polygon& zone : layers.keep_out) applyKeepOut(zone);
  steps_ = surfaceSteps(
      states(), config_.height_step_weight > 0.0 ? layers.levels : nullptr,
      static_cast<std::int32_t>(std::lround(config_.height_step_weight * 0.01 / resolution_m() * kStraightMin)));
}

void CostMap::closeBorder() {
  const int width = rect().width(), height = rect().height();
  if (cost_.size() == 0) return;
  std::fill_n(cost_.begin(), width, kLethal);
  std::fill_n(cost_.end() - width, width, kLethal);
  for (int y = 0; y < height; ++y) {
    cost_[static_cast<std::size_t>(y) * width] = kLethal;
    cost_[static_cast<std::size_t>(y) * width + width - 1] = kLethal;
  }
}

void CostMap::applyFlown(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) {
  // A longer step is a correction of the map and not a flight (docs/decisions/planning.md#010).
  constexpr double kWithin_m = 0.075, kJump_m = 1.0;
  const Eigen::Vector2d step = to_map_m - from_map_m;
  if (!step.allFinite() || step.norm() > kJump_m) return;
  const double least_m = footprint_.hull_radius_m + 0.5 * footprint_.clearance_m;
  const Eigen::Vector2d within = Eigen::Vector2d::Constant(kWithin_m);
  const common::CellIndex low = cellAt(from_map_m.cwiseMin(to_map_m) - within);
  const common::CellIndex high = cellAt(from_map_m.cwiseMax(to_map_m) + within);
  for (int y = std::max(low.y, rect().begin.y); y <= std::min(high.y, rect().end.y - 1); ++y) {
    for (int x = std::max(low.x, rect().begin.x); x <= std::min(high.x, rect().end.x - 1); ++x) {
      if (common::segmentDistance(centerOf({x, y}), from_map_m, to_map_m) > kWithin_m) continue;
      Cost& cost = cost_[static_cast<std::size_t>(indexOf({x, y}))];
      if (cost == kLethal && states().at({x, y}) == CellState::kFree &&
          clearance_.at_m(common::CellIndex{x, y}, Against::kObstacles) >= least_m)
        cost = costOfMargin(0.0);
    }
  }
}

void CostMap::applyDisc(const common::Disc& disc) {
  if (!disc.center_map_m.allFinite()) return;
  const double lethal_m = disc.radius_m + footprint_.radius_m();
  const double reach_m = lethal_m + (this->reach_m() - footprint_.radius_m());
  const Eigen::Vector2d corner = Eigen::Vector2d::Constant(reach_m);
  const common::CellIndex low = cellAt(disc.center_map_m - corner), high = cellAt(disc.center_map_m + corner);
  for (int y = std::max(low.y, rect().begin.y); y <= std::min(high.y, rect().end.y - 1); ++y) {
    for (int x = std::max(low.x, rect().begin.x); x <= std::min(high.x, rect().end.x - 1); ++x) {
      const double margin_m = (centerOf({x, y}) - disc.center_map_m).norm() - lethal_m;
      const auto i = static_cast<std::size_t>(indexOf({x, y}));
      if (margin_m < 0.0 && cost_[i] != kLethal) by_disc_[i] = 1;
      cost_[i] = std::max(cost_[i], costOfMargin(margin_m));
    }
  }
}

void CostMap::applyKeepOut(const common::Polygon& zone) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m());
  const common::CellIndex low = cellAt(zone.min_map_m() - reach), high = cellAt(zone.max_map_m() + reach);
  for (int y = std::max(low.y, rect().begin.y); y <= std::min(high.y, rect().end.y - 1); ++y) {
    for (int x = std::max(low.x, rect().begin.x); x <= std::min(high.x, rect().end.x - 1); ++x) {
      const double margin_m = zone.signedDistance_m(centerOf({x, y})) - footprint_.radius_m();
      const auto i = static_cast<std::size_t>(indexOf({x, y}));
      cost_[i] = std::max(cost_[i], costOfMargin(margin_m));
      if (margin_m < 0.0) kept_out_[i] = 1;
    }
  }
}

}  // namespace swiftlet::planning
