// The layers over the grid of a cost map: flown paths, discs, keep-out zones, heights.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/segment.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {
namespace {

/// Greatest step of the surface, so that the cost of an edge is bounded: levels are taken as within 2.5 m of the
/// take-off floor.
constexpr double kMaxStep_m = 5.0;

}  // namespace

void CostMap::applyLayers(const CostLayers& layers) {
  cost_ = static_cost_;
  for (std::size_t i = 1; i < layers.flown_map_m.size(); ++i)
    applyFlown(layers.flown_map_m[i - 1], layers.flown_map_m[i]);
  closeBorder();
  by_disc_.assign(layers.discs.empty() ? 0 : size(), 0);
  for (const common::Disc& disc : layers.discs) applyDisc(disc);
  kept_out_.assign(layers.keep_out.empty() ? 0 : size(), 0);
  for (const common::Polygon& zone : layers.keep_out) applyKeepOut(zone);
  applyHeights(layers.levels);

  if (size() == 0) return;
  const double greatest_cell = kOpenCost * (1.0 + config_.comfort_weight) + 1.0;
  max_edge_cost_ = static_cast<std::int32_t>(2 * kDiagonalEdge * greatest_cell) +
                   (height_cm_.empty() ? 0 : height_edge_ * static_cast<int>(kMaxStep_m * 100.0));
}

void CostMap::closeBorder() {
  const int width = rect_.width(), height = rect_.height();
  if (size() == 0) return;
  std::fill_n(cost_.begin(), width, kLethal);
  std::fill_n(cost_.end() - width, width, kLethal);
  for (int y = 0; y < height; ++y) {
    cost_[static_cast<std::size_t>(y) * width] = kLethal;
    cost_[static_cast<std::size_t>(y) * width + width - 1] = kLethal;
  }
}

void CostMap::applyFlown(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) {
  // Decision 010. A longer step is a correction of the map and not a flight.
  constexpr double kWithin_m = 0.075, kJump_m = 1.0;
  const Eigen::Vector2d step = to_map_m - from_map_m;
  if (!step.allFinite() || step.norm() > kJump_m) return;
  const double least_m = footprint_.hull_radius_m + 0.5 * footprint_.clearance_m;
  const Eigen::Vector2d within = Eigen::Vector2d::Constant(kWithin_m);
  const common::CellIndex low = cellAt(from_map_m.cwiseMin(to_map_m) - within);
  const common::CellIndex high = cellAt(from_map_m.cwiseMax(to_map_m) + within);
  for (int y = std::max(low.y, rect_.begin.y); y <= std::min(high.y, rect_.end.y - 1); ++y) {
    for (int x = std::max(low.x, rect_.begin.x); x <= std::min(high.x, rect_.end.x - 1); ++x) {
      if (common::segmentDistance(centerOf({x, y}), from_map_m, to_map_m) > kWithin_m) continue;
      Cost& cost = cost_[static_cast<std::size_t>(indexOf({x, y}))];
      if (cost == kLethal && stateAt({x, y}) == CellState::kFree && obstacleDistance_m({x, y}) >= least_m)
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
  for (int y = std::max(low.y, rect_.begin.y); y <= std::min(high.y, rect_.end.y - 1); ++y) {
    for (int x = std::max(low.x, rect_.begin.x); x <= std::min(high.x, rect_.end.x - 1); ++x) {
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
  for (int y = std::max(low.y, rect_.begin.y); y <= std::min(high.y, rect_.end.y - 1); ++y) {
    for (int x = std::max(low.x, rect_.begin.x); x <= std::min(high.x, rect_.end.x - 1); ++x) {
      const double margin_m = zone.signedDistance_m(centerOf({x, y})) - footprint_.radius_m();
      const auto i = static_cast<std::size_t>(indexOf({x, y}));
      cost_[i] = std::max(cost_[i], costOfMargin(margin_m));
      if (margin_m < 0.0) kept_out_[i] = 1;
    }
  }
}

void CostMap::applyHeights(const common::LevelMap* levels) {
  height_cm_.clear();
  const bool flat = levels == nullptr || config_.height_step_weight <= 0.0 ||
                    std::all_of(levels->levels.begin(), levels->levels.end(),
                                [](const common::Level& level) { return std::abs(level.height_m) < 0.01; });
  if (flat) return;
  height_edge_ =
      static_cast<std::int32_t>(std::lround(config_.height_step_weight * 0.01 / resolution_m() * kStraightMin));
  constexpr std::int16_t kNoLevel = std::numeric_limits<std::int16_t>::min();
  height_cm_.assign(size(), kNoLevel);
  const double half_m = 0.5 * levels->resolution_m;
  for (const common::Level& level : levels->levels) {
    const auto height_cm =
        static_cast<std::int16_t>(std::lround(std::clamp(level.height_m, -0.5 * kMaxStep_m, 0.5 * kMaxStep_m) * 100.0));
    for (const common::CellIndex cell : level.cells) {
      const Eigen::Vector2d low_m{cell.x * levels->resolution_m, cell.y * levels->resolution_m};
      const common::CellIndex low = cellAt(low_m), high = cellAt(low_m + Eigen::Vector2d::Constant(2.0 * half_m));
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const Eigen::Vector2d offset_m = centerOf({x, y}) - low_m;
          if (!contains({x, y}) || offset_m.minCoeff() < 0.0 || offset_m.maxCoeff() >= levels->resolution_m) continue;
          std::int16_t& known_cm = height_cm_[static_cast<std::size_t>(indexOf({x, y}))];
          known_cm = std::max(known_cm, height_cm);
        }
      }
    }
  }
  std::replace(height_cm_.begin(), height_cm_.end(), kNoLevel, std::int16_t{0});  // The take-off floor.
}

}  // namespace swiftlet::planning
