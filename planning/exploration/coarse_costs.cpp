#include "planning/exploration/coarse_costs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace swiftlet::planning {
namespace {

/// Less than half of what is lethal around a wall, twice the radius of the hull, along a diagonal.
constexpr double kCoarse_m = 0.2;
constexpr std::int32_t kNotSpent = INT32_MAX;

}  // namespace

CoarseCosts::CoarseCosts(const CostMap& map, const CostField& from_vehicle)
    : rect_(map.rect()), side_(std::max(1, static_cast<int>(kCoarse_m / map.resolution_m() + 1e-6))) {
  coarse_m_ = side_ * map.resolution_m();
  // A margin of one lethal cell around.
  columns_ = (rect_.width() + side_ - 1) / side_ + 2;
  rows_ = (rect_.height() + side_ - 1) / side_ + 2;
  cost_.assign(static_cast<std::size_t>(columns_) * rows_, CostMap::kLethal);
  for (int y = 0, index = 0; y < rect_.height(); ++y)
    for (int x = 0; x < rect_.width(); ++x, ++index) {
      if (!from_vehicle.reached(index)) continue;
      CostMap::Cost& coarse = cost_[static_cast<std::size_t>((y / side_ + 1) * columns_ + x / side_ + 1)];
      coarse = std::min(coarse, map.costs()[static_cast<std::size_t>(index)]);
    }
}

int CoarseCosts::coarseOf(common::CellIndex cell) const {
  return ((cell.y - rect_.begin.y) / side_ + 1) * columns_ + (cell.x - rect_.begin.x) / side_ + 1;
}

std::vector<double> CoarseCosts::between_m(common::CellIndex from, std::span<const common::CellIndex> to) {
  using Entry = std::pair<std::int32_t, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  spent_.assign(cost_.size(), kNotSpent);
  std::vector<std::uint8_t> wanted(cost_.size(), 0);
  std::size_t left = 0;
  for (const common::CellIndex place : to) {
    std::uint8_t& is_wanted = wanted[static_cast<std::size_t>(coarseOf(place))];
    if (is_wanted == 0) ++left;
    is_wanted = 1;
  }
  const int start = coarseOf(from);
  spent_[static_cast<std::size_t>(start)] = 0;
  open.push({0, start});
  while (!open.empty() && left > 0) {
    const auto [spent, at] = open.top();
    open.pop();
    const auto i = static_cast<std::size_t>(at);
    if (spent != spent_[i]) continue;
    if (wanted[i] != 0) {
      wanted[i] = 0;
      --left;
    }
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto next = static_cast<std::size_t>(at + dy * columns_ + dx);
        if (cost_[next] == CostMap::kLethal) continue;
        const int edge = dx != 0 && dy != 0 ? CostMap::kDiagonalEdge : CostMap::kStraightEdge;
        const std::int32_t through = spent + edge * ((at == start ? cost_[next] : cost_[i]) + cost_[next]);
        if (through >= spent_[next]) continue;
        spent_[next] = through;
        open.push({through, static_cast<int>(next)});
      }
  }
  std::vector<double> costs_m;
  costs_m.reserve(to.size());
  for (const common::CellIndex place : to) {
    const std::int32_t spent = spent_[static_cast<std::size_t>(coarseOf(place))];
    costs_m.push_back(spent == kNotSpent ? std::numeric_limits<double>::infinity()
                                         : spent * (coarse_m_ / CostMap::kStraightMin));
  }
  return costs_m;
}

}  // namespace swiftlet::planning
