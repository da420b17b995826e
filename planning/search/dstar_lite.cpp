#include "planning/search/dstar_lite.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "common/check.hpp"
#include "planning/search/admission.hpp"

namespace swiftlet::planning {

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
  const bool kept = map.rect() == rect_ && map.resolution_m() == resolution_m_ && goal == goal_ &&
                    map.steps().heights_cm.size() == steps_.heights_cm.size() &&
                    map.steps().cost_per_cm == steps_.cost_per_cm && key_offset_ < kGreatestOffset;
  if (kept) {
    key_offset_ += static_cast<std::uint32_t>(heuristic(start_, start));
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
  resolution_m_ = map.resolution_m();
  stride_ = map.rect().width();
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
/// diagonals beside it. All of these start or end among its neighbours.
void DStarLite::adoptChanges(const CostMap& map) {
  std::vector<std::int32_t> affected;
  const auto add = [&](std::int32_t index) {
    for (const int row : {index - stride_, index, index + stride_}) {
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
      touch(static_cast<std::int32_t>(i)).cost = now[i];
      add(static_cast<std::int32_t>(i));
    }
  }
  for (const std::int32_t index : affected) {
    Vertex& vertex = touch(index);
    if (index != goal_) vertex.rhs = bestOverNeighbours(index);
    updateVertex(index, vertex);
    marked_[static_cast<std::size_t>(index)] = 0;
  }
}

/// Figure 4, ComputeShortestPath.
void DStarLite::search() {
  while (!heap_.empty()) {
    const Vertex& start = touch(start_);
    const Entry top = heap_.front();
    if (top.key >= keyOf(start_, start) && start.rhs <= start.g) return;
    ++expansions_;
    Vertex& vertex = touch(top.index);
    const Key key = keyOf(top.index, vertex);
    if (top.key < key) {
      siftDown(0, {key, top.index});
      continue;
    }
    if (vertex.g > vertex.rhs) {
      vertex.g = vertex.rhs;
      remove(vertex);
      for (const Edge& edge : edgesOf(top.index)) {
        Vertex& neighbour = touch(edge.to);
        if (edge.cost + vertex.g >= neighbour.rhs) continue;
        neighbour.rhs = edge.cost + vertex.g;
        updateVertex(edge.to, neighbour);
      }
      continue;
    }
    const std::int32_t g_old = vertex.g;
    vertex.g = kInfinity;
    for (const Edge& edge : edgesOf(top.index)) {
      Vertex& neighbour = touch(edge.to);
      if (edge.to == goal_ || neighbour.rhs != edge.cost + g_old) continue;
      neighbour.rhs = bestOverNeighbours(edge.to);
      updateVertex(edge.to, neighbour);
    }
    updateVertex(top.index, vertex);
  }
}

CellPath DStarLite::follow(const CostMap& map) {
  CellPath path{map.cellOf(start_)};
  for (std::int32_t at = start_; at != goal_;) {
    std::int32_t best = kInfinity, next = -1;
    for (const Edge& edge : edgesOf(at)) {
      const std::int32_t sum = edge.cost + touch(edge.to).g;
      if (sum >= best) continue;
      best = sum;
      next = edge.to;
    }
    SWIFTLET_CHECK(next >= 0 && path.size() <= vertices_.size(), at, next);
    path.push_back(map.cellOf(next));
    at = next;
  }
  return path;
}

DStarLite::Vertex& DStarLite::touch(std::int32_t index) {
  Vertex& vertex = vertices_[static_cast<std::size_t>(index)];
  if (vertex.generation != generation_)
    vertex = {kInfinity, kInfinity, -1, cost_[static_cast<std::size_t>(index)], generation_};
  return vertex;
}

DStarLite::Edges DStarLite::edgesOf(std::int32_t index) {
  Edges result;
  const CostMap::Cost cost = cost_[static_cast<std::size_t>(index)];
  if (cost == CostMap::kLethal) return result;
  const CostMap::Cost* here = &cost_[static_cast<std::size_t>(index)];
  const auto add = [&](std::int32_t step, std::int32_t scale) {
    if (here[step] == CostMap::kLethal) return;
    const std::int32_t sum = scale * (cost + here[step]) + steps_.cost(index, index + step);
    result.edges[result.count++] = {index + step, sum};
  };
  const bool west = here[-1] != CostMap::kLethal, east = here[1] != CostMap::kLethal;
  const bool south = here[-stride_] != CostMap::kLethal, north = here[stride_] != CostMap::kLethal;
  if (south && west) add(-stride_ - 1, scale_.diagonal);
  if (south) add(-stride_, scale_.straight);
  if (south && east) add(-stride_ + 1, scale_.diagonal);
  if (west) add(-1, scale_.straight);
  if (east) add(1, scale_.straight);
  if (north && west) add(stride_ - 1, scale_.diagonal);
  if (north) add(stride_, scale_.straight);
  if (north && east) add(stride_ + 1, scale_.diagonal);
  return result;
}

std::int32_t DStarLite::bestOverNeighbours(std::int32_t index) {
  std::int32_t best = kInfinity;
  for (const Edge& edge : edgesOf(index)) best = std::min(best, edge.cost + touch(edge.to).g);
  return best;
}

std::int32_t DStarLite::heuristic(std::int32_t a, std::int32_t b) const {
  const int dx = std::abs(a % stride_ - b % stride_), dy = std::abs(a / stride_ - b / stride_);
  const int diagonal = std::min(dx, dy), straight = std::max(dx, dy) - diagonal;
  return 2 * CostMap::kOpenCost * (scale_.diagonal * diagonal + scale_.straight * straight);
}

DStarLite::Key DStarLite::keyOf(std::int32_t index, const Vertex& vertex) const {
  const std::int32_t least = std::min(vertex.g, vertex.rhs);
  if (least >= kInfinity) return UINT64_MAX;
  const std::uint32_t k1 = static_cast<std::uint32_t>(least + heuristic(start_, index)) + key_offset_;
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
