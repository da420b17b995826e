#include "planning/search/dstar_lite.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "common/check.hpp"
#include "planning/search/admission.hpp"

namespace swiftlet::planning {
namespace {

constexpr int kFraction = 40;  ///< Bits of DStarLite::rows_.reciprocal after the point.

}  // namespace

tl::expected<Path, PlanFailure> DStarLite::plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                const Eigen::Vector2d& goal_map_m) {
  const auto plan = planCells(map, start_map_m, goal_map_m);
  if (!plan) return tl::make_unexpected(plan.error());
  return shortened(map, plan->cells, plan->escape_cells, start_map_m, goal_map_m);
}

tl::expected<CellPlan, PlanFailure> DStarLite::planCells(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                         const Eigen::Vector2d& goal_map_m) {
  expansions_ = 0;
  tl::expected<CellPath, PlanFailure> chain = admit(map, start_map_m, goal_map_m);
  if (!chain) return tl::make_unexpected(chain.error());

  const std::int32_t start = map.indexOf(chain->back()), goal = map.indexOf(map.cellAt(goal_map_m));
  constexpr std::uint32_t kGreatestOffset = 1u << 30;
  const bool kept = map.rect() == rect_ && map.resolution_m() == rows_.resolution_m && goal == goal_ &&
                    map.steps().heights_cm.size() == steps_.heights_cm.size() &&
                    map.steps().cost_per_cm == steps_.cost_per_cm && key_offset_ < kGreatestOffset;
  if (kept) {
    const common::CellIndex before = std::exchange(start_offset_, offsetOf(start));
    key_offset_ += static_cast<std::uint32_t>(heuristic(before, start_offset_));
    start_ = start;
    adoptChanges(map);
  } else {
    start_ = start;
    restart(map, goal);
  }
  search();
  search_cost_ = touch(start_).rhs;
  if (search_cost_ >= kInfinity) return tl::make_unexpected(unreachable(map, goal_map_m));

  const std::size_t escape_cells = chain->size() - 1;
  const CellPath rest = follow(map);
  chain->insert(chain->end(), rest.begin() + 1, rest.end());
  return CellPlan{*std::move(chain), escape_cells};
}

void DStarLite::restart(const CostMap& map, int goal) {
  rect_ = map.rect();
  rows_.resolution_m = map.resolution_m();
  rows_.stride = map.rect().width();
  // Exact for every index of the rectangle.
  constexpr std::uint64_t kOne = std::uint64_t{1} << kFraction;
  SWIFTLET_CHECK(map.costs().size() * static_cast<std::size_t>(rows_.stride) < kOne, map.costs().size(), rows_.stride);
  rows_.reciprocal = (kOne + static_cast<std::uint64_t>(rows_.stride) - 1) / static_cast<std::uint64_t>(rows_.stride);
  start_offset_ = offsetOf(start_);
  goal_ = goal;
  key_offset_ = 0;
  cost_ = map.costs();
  marked_.assign(cost_.size(), 0);
  steps_ = map.steps();
  heap_.clear();
  if (vertices_.size() != map.costs().size() || generation_ == UINT16_MAX) {
    vertices_.assign(map.costs().size(), Vertex{});
    generation_ = 0;
  }
  ++generation_;
  Vertex& vertex = touch(goal);
  vertex.rhs = 0;
  insert(goal, keyOf(goal, vertex));
}

/// Figure 4, lines 25 to 38, for all edges of all changed cells at once. A changed cell changes its own edges and the
/// diagonals beside it. All of these start or end among its neighbours. Nothing leads to a cell that has become lethal,
/// so its cost is forgotten at once, without a turn in the queue.
void DStarLite::adoptChanges(const CostMap& map) {
  std::vector<std::int32_t> affected;
  const auto add = [&](std::int32_t index) {
    for (const int row : {index - rows_.stride, index, index + rows_.stride}) {
      for (int i = row - 1; i <= row + 1; ++i) {
        if (marked_[static_cast<std::size_t>(i)]) continue;
        marked_[static_cast<std::size_t>(i)] = 1;
        affected.push_back(i);
      }
    }
  };
  constexpr std::size_t kBlock = 64;  // The rectangle is made of tiles this wide.
  const auto& now = map.costs();
  const auto& heights = map.steps().heights_cm;
  for (std::size_t block = 0; block < now.size(); block += kBlock) {
    const bool same = std::memcmp(&now[block], &cost_[block], kBlock * sizeof(CostMap::Cost)) == 0;
    const bool level =
        heights.empty() || std::memcmp(&heights[block], &steps_.heights_cm[block], kBlock * sizeof(std::int16_t)) == 0;
    if (same && level) continue;
    for (std::size_t i = block; i < block + kBlock; ++i) {
      if (now[i] == cost_[i] && (heights.empty() || heights[i] == steps_.heights_cm[i])) continue;
      cost_[i] = now[i];
      if (!heights.empty()) steps_.heights_cm[i] = heights[i];
      add(static_cast<std::int32_t>(i));
    }
  }
  for (const std::int32_t index : affected) {
    Vertex& vertex = vertices_[static_cast<std::size_t>(index)];
    if (vertex.generation != generation_) continue;  // Its edges are found when it is touched.
    vertex.moves = movesFrom(index);
    if (cost_[static_cast<std::size_t>(index)] == CostMap::kLethal && index != goal_) vertex.g = kInfinity;
  }
  raiseFrom(affected);
}

/// Underconsistent vertices, and those that were reached through them, are raised here, each about once. Through the
/// queue each would be raised by turns with its neighbours, through which it seems to be reached for a while
/// (Ramalingam and Reps 1996 raise before they lower, too). Vertices whose keys the search did not reach are left to
/// the queue, where most are never needed again.
void DStarLite::raiseFrom(std::vector<std::int32_t>& affected) {
  const Key reach = keyOf(start_, touch(start_));
  for (std::size_t i = 0; i < affected.size(); ++i) {
    const std::int32_t index = affected[i];
    marked_[static_cast<std::size_t>(index)] = 0;
    if (index == goal_) continue;
    Vertex& vertex = touch(index);
    lookAhead(index, vertex);
    if (vertex.rhs <= vertex.g || keyOf(index, vertex) > reach) continue;
    vertex.g = kInfinity;
    forEdges(index, vertex.moves, [&](std::int32_t to, int neighbour, std::int32_t) {
      if (touch(to).parent != kNeighbours - 1 - neighbour || marked_[static_cast<std::size_t>(to)]) return;
      marked_[static_cast<std::size_t>(to)] = 1;
      affected.push_back(to);
    });
  }
  for (const std::int32_t index : affected) updateVertex(index, touch(index));
}

/// Figure 4, ComputeShortestPath.
void DStarLite::search() {
  while (!heap_.empty()) {
    const Vertex& start = touch(start_);
    const Entry top = heap_.front();
    if (top.key >= keyOf(start_, start) && start.rhs <= start.g) return;
    ++expansions_;
    Vertex& vertex = touch(top.index);
    if (const Key key = keyOf(top.index, vertex); top.key < key)
      siftDown(0, {key, top.index});
    else if (vertex.g > vertex.rhs)
      expand(top.index, vertex);
    else
      raise(top.index, vertex);
  }
}

/// The cost of an overconsistent vertex is final: its neighbours are reached through it where that is cheaper.
void DStarLite::expand(std::int32_t index, Vertex& vertex) {
  vertex.g = vertex.rhs;
  remove(vertex);
  forEdges(index, vertex.moves, [&](std::int32_t to, int neighbour, std::int32_t cost) {
    Vertex& reached = touch(to);
    if (cost + vertex.g >= reached.rhs) return;
    reached.rhs = cost + vertex.g;
    reached.parent = static_cast<std::uint8_t>(kNeighbours - 1 - neighbour);
    updateVertex(to, reached);
  });
}

/// The cost of an underconsistent vertex is forgotten. Only neighbours whose rhs comes from it change; another one of
/// the same rhs keeps it.
void DStarLite::raise(std::int32_t index, Vertex& vertex) {
  vertex.g = kInfinity;
  forEdges(index, vertex.moves, [&](std::int32_t to, int neighbour, std::int32_t) {
    Vertex& child = touch(to);
    if (child.parent != kNeighbours - 1 - neighbour || to == goal_) return;
    lookAhead(to, child);
    updateVertex(to, child);
  });
  updateVertex(index, vertex);
}

CellPath DStarLite::follow(const CostMap& map) {
  CellPath path{map.cellOf(start_)};
  for (std::int32_t at = start_; at != goal_;) {
    std::int32_t best = kInfinity, next = -1;
    forEdges(at, touch(at).moves, [&](std::int32_t to, int, std::int32_t cost) {
      const std::int32_t sum = cost + touch(to).g;
      if (sum >= best) return;
      best = sum;
      next = to;
    });
    SWIFTLET_CHECK(next >= 0 && path.size() <= vertices_.size(), at, next);
    path.push_back(map.cellOf(next));
    at = next;
  }
  return path;
}

inline DStarLite::Vertex& DStarLite::touch(std::int32_t index) {
  Vertex& vertex = vertices_[static_cast<std::size_t>(index)];
  if (vertex.generation != generation_) vertex = {kInfinity, kInfinity, -1, movesFrom(index), kNone, generation_};
  return vertex;
}

/// None from or to a lethal cell, and no corner is cut.
std::uint8_t DStarLite::movesFrom(std::int32_t index) const {
  const CostMap::Cost* here = &cost_[static_cast<std::size_t>(index)];
  if (*here == CostMap::kLethal) return 0;
  const auto open = [&](int step) { return here[step] != CostMap::kLethal ? 1u : 0u; };
  const unsigned south = open(-rows_.stride), west = open(-1), east = open(1), north = open(rows_.stride);
  const unsigned moves = (south & west & open(-rows_.stride - 1)) | south << 1 |
                         (south & east & open(-rows_.stride + 1)) << 2 | west << 3 | east << 4 |
                         (north & west & open(rows_.stride - 1)) << 5 | north << 6 |
                         (north & east & open(rows_.stride + 1)) << 7;
  return static_cast<std::uint8_t>(moves);
}

template <class Visit>
inline void DStarLite::forEdges(std::int32_t index, std::uint8_t moves, Visit visit) const {
  const std::array<std::int32_t, kNeighbours> steps{-rows_.stride - 1, -rows_.stride, -rows_.stride + 1, -1, 1,
                                                    rows_.stride - 1,  rows_.stride,  rows_.stride + 1};
  constexpr unsigned kDiagonals = 0b10100101;
  const std::int32_t cost = cost_[static_cast<std::size_t>(index)];
  for (unsigned left = moves; left != 0; left &= left - 1) {
    const int neighbour = std::countr_zero(left);
    const std::int32_t to = index + steps[static_cast<std::size_t>(neighbour)];
    const std::int32_t scale = (kDiagonals >> neighbour & 1u) != 0 ? scale_.diagonal : scale_.straight;
    visit(to, neighbour, scale * (cost + cost_[static_cast<std::size_t>(to)]) + steps_.cost(index, to));
  }
}

void DStarLite::lookAhead(std::int32_t index, Vertex& vertex) {
  vertex.rhs = kInfinity;
  vertex.parent = kNone;
  forEdges(index, vertex.moves, [&](std::int32_t to, int neighbour, std::int32_t cost) {
    const std::int32_t sum = cost + touch(to).g;
    if (sum >= vertex.rhs) return;
    vertex.rhs = sum;
    vertex.parent = static_cast<std::uint8_t>(neighbour);
  });
}

inline common::CellIndex DStarLite::offsetOf(std::int32_t index) const {
  const auto row = static_cast<std::int32_t>(static_cast<std::uint64_t>(index) * rows_.reciprocal >> kFraction);
  return {index - row * rows_.stride, row};
}

inline std::int32_t DStarLite::heuristic(common::CellIndex a, common::CellIndex b) const {
  const int dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  const int diagonal = std::min(dx, dy), straight = std::max(dx, dy) - diagonal;
  return 2 * CostMap::kOpenCost * (scale_.diagonal * diagonal + scale_.straight * straight);
}

inline DStarLite::Key DStarLite::keyOf(std::int32_t index, const Vertex& vertex) const {
  const std::int32_t least = std::min(vertex.g, vertex.rhs);
  if (least >= kInfinity) return UINT64_MAX;
  const std::uint32_t k1 = static_cast<std::uint32_t>(least + heuristic(start_offset_, offsetOf(index))) + key_offset_;
  return static_cast<Key>(k1) << 32 | static_cast<std::uint32_t>(least);
}

void DStarLite::updateVertex(std::int32_t index, Vertex& vertex) {
  if (vertex.g == vertex.rhs) {
    if (vertex.place >= 0) remove(vertex);
    return;
  }
  const Key key = keyOf(index, vertex);
  if (vertex.place < 0) {
    insert(index, key);
    return;
  }
  const auto place = static_cast<std::size_t>(vertex.place);
  if (key < heap_[place].key)
    siftUp(place, {key, index});
  else
    siftDown(place, {key, index});
}

}  // namespace swiftlet::planning
