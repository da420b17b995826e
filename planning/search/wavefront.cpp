#include "planning/search/wavefront.hpp"

#include <algorithm>
#include <array>

#include "common/check.hpp"
#include "planning/search/admission.hpp"
#include "planning/search/edge_cost.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;

constexpr std::array<std::array<int, 2>, 8> kDirections{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::uint8_t kSource = 8;
constexpr std::uint8_t kSettled = 0x80;
constexpr std::uint8_t kDirectionMask = 0x0F;

}  // namespace

void CostField::spread(const CostMap& map, CellIndex source, std::optional<CellIndex> until) {
  SWIFTLET_CHECK(map.costAt(source) != CostMap::kLethal, source.x, source.y);
  cost_.assign(map.costs().size(), kUnreached);
  from_.assign(map.costs().size(), kSource);
  // An edge reaches at most this many buckets ahead, so that the ring never overtakes itself.
  const auto ring = static_cast<std::size_t>(greatestEdgeCost(map) / CostMap::kStraightMin + 2);
  buckets_.assign(ring, {});
  std::array<int, 8> offsets;
  for (std::size_t d = 0; d < 8; ++d) offsets[d] = kDirections[d][1] * map.rect().width() + kDirections[d][0];

  const std::int32_t first = map.indexOf(source), last = until ? map.indexOf(*until) : -1;
  cost_[static_cast<std::size_t>(first)] = 0;
  buckets_[0].push_back(first);
  std::size_t waiting = 1;
  settled_ = 0;
  for (std::int32_t bucket = 0; waiting > 0; ++bucket) {
    std::vector<std::int32_t>& cells = buckets_[static_cast<std::size_t>(bucket) % ring];
    waiting -= cells.size();
    for (const std::int32_t cell : cells) {
      const auto i = static_cast<std::size_t>(cell);
      if (cost_[i] / CostMap::kStraightMin != bucket || (from_[i] & kSettled)) continue;
      from_[i] |= kSettled;
      ++settled_;
      for (std::size_t d = 0; d < 8; ++d) {
        const auto next = static_cast<std::size_t>(cell + offsets[d]);
        if (cost_[next] <= cost_[i] + CostMap::kStraightMin) continue;
        const std::int32_t edge = edgeCost(map, cell, kDirections[d][0], kDirections[d][1]);
        if (edge == kNoEdge || cost_[i] + edge >= cost_[next]) continue;
        cost_[next] = cost_[i] + edge;
        from_[next] = static_cast<std::uint8_t>(d);
        buckets_[static_cast<std::size_t>(cost_[next] / CostMap::kStraightMin) % ring].push_back(
            static_cast<std::int32_t>(next));
        ++waiting;
      }
    }
    cells.clear();
    if (last >= 0 && (from_[static_cast<std::size_t>(last)] & kSettled)) return;
  }
}

CellPath CostField::pathTo(const CostMap& map, CellIndex target) const {
  CellPath path;
  std::int32_t at = map.indexOf(target);
  SWIFTLET_CHECK(reached(at), target.x, target.y);
  while (true) {
    path.push_back(map.cellOf(at));
    const std::uint8_t direction = from_[static_cast<std::size_t>(at)] & kDirectionMask;
    if (direction == kSource) break;
    at -= kDirections[direction][1] * map.rect().width() + kDirections[direction][0];
  }
  std::reverse(path.begin(), path.end());
  return path;
}

tl::expected<Path, PlanFailure> Wavefront::plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                const Eigen::Vector2d& goal_map_m) {
  tl::expected<CellPath, PlanFailure> chain = admit(map, start_map_m, goal_map_m);
  if (!chain) return tl::make_unexpected(chain.error());
  const CellIndex goal = map.cellAt(goal_map_m);
  field_.spread(map, chain->back(), goal);
  if (!field_.reached(map.indexOf(goal))) return tl::make_unexpected(unreachable(map, goal_map_m));
  search_cost_ = field_.at(map.indexOf(goal));
  const std::size_t escape_cells = chain->size() - 1;
  const CellPath rest = field_.pathTo(map, goal);
  chain->insert(chain->end(), rest.begin() + 1, rest.end());
  return shortened(map, *chain, escape_cells, start_map_m, goal_map_m);
}

}  // namespace swiftlet::planning
