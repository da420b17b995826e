// D* Lite, optimized version (Koenig and Likhachev 2002, figure 4), the planner of Grzonka 2012, section IV-E. When
// cells have changed or the vehicle has moved, it repairs the search of the last plan.
#pragma once

#include <cstdint>
#include <vector>

#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// The costs of a straight and of a diagonal edge, times the sum of the costs of its two cells.
struct EdgeScale {
  std::int32_t straight = CostMap::kStraightEdge;
  std::int32_t diagonal = CostMap::kDiagonalEdge;
};
/// 1393 / 985 is the square root of 2 within 3e-7: paths over cells of equal cost have the least length, where that of
/// flights is within 0.2 % of it. A path of 68,000 open cells is the longest.
inline constexpr EdgeScale kOctileScale{985, 1393};

/// A chain of cells from the start to the goal, of which the first are the escape.
struct CellPlan {
  CellPath cells;
  std::size_t escape_cells = 0;
};

/// Neighbours are 8-connected and no corner is cut. Costs are integers, kept in arrays over the dense rectangle of the
/// cost map. The search is kept for the same goal cell; another goal, rectangle or resolution starts a new one. Each
/// call compares the costs with those of the last call, so any map may be given at any time. The cost of a path must
/// stay below 2^30, which is about 100 km of expensive cells.
class DStarLite final : public Planner {
 public:
  explicit DStarLite(EdgeScale scale = {}) : scale_(scale) {}

  [[nodiscard]] tl::expected<Path, PlanFailure> plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                     const Eigen::Vector2d& goal_map_m) override;

  /// The same path, as the cells that the search found.
  [[nodiscard]] tl::expected<CellPlan, PlanFailure> planCells(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                              const Eigen::Vector2d& goal_map_m);

  const char* name() const override { return "D* Lite"; }

  /// The cost of the cell path of the last successful plan, from where the search started to the goal; for tests.
  std::int32_t searchCost() const { return search_cost_; }
  /// Vertices taken from the queue by the last plan.
  int expansions() const { return expansions_; }

 private:
  static constexpr std::int32_t kInfinity = 1 << 30;
  using Key = std::uint64_t;  ///< (k1, k2) packed: compares as the pair does.

  /// Neighbours are numbered row by row, so that 7 - i is the direction back from neighbour i.
  static constexpr int kNeighbours = 8;
  static constexpr std::uint8_t kNone = kNeighbours;

  /// The state of a cell. 16 bytes, so that a row of neighbours shares a cache line.
  struct Vertex {
    std::int32_t g = kInfinity;
    std::int32_t rhs = kInfinity;
    std::int32_t place = -1;       ///< Position in the heap; -1: not in it.
    std::uint8_t moves = 0;        ///< Bit i: an edge leads to neighbour i.
    std::uint8_t parent = kNone;   ///< The neighbour whose g gives rhs.
    std::uint16_t generation = 0;  ///< If older than generation_, not touched since the restart.
  };
  struct Entry {
    Key key;
    std::int32_t index;
  };

  void restart(const CostMap& map, int goal);
  void adoptChanges(const CostMap& map);
  void raiseFrom(std::vector<std::int32_t>& affected);
  void search();
  CellPath follow(const CostMap& map);

  Vertex& touch(std::int32_t index);
  std::uint8_t movesFrom(std::int32_t index) const;
  /// Calls `visit(neighbour, its number, cost of the edge)` for each edge of a cell.
  template <class Visit>
  void forEdges(std::int32_t index, std::uint8_t moves, Visit visit) const;
  /// Sets rhs and parent by the neighbours.
  void lookAhead(std::int32_t index, Vertex& vertex);
  void expand(std::int32_t index, Vertex& vertex);
  void raise(std::int32_t index, Vertex& vertex);
  common::CellIndex offsetOf(std::int32_t index) const;
  std::int32_t heuristic(common::CellIndex a, common::CellIndex b) const;
  Key keyOf(std::int32_t index, const Vertex& vertex) const;
  void updateVertex(std::int32_t index, Vertex& vertex);

  void insert(std::int32_t index, Key key);
  void remove(Vertex& vertex);
  void siftUp(std::size_t place, Entry entry);
  void siftDown(std::size_t place, Entry entry);

  EdgeScale scale_;
  common::CellRect rect_;
  struct Rows {
    double resolution_m = 0.0;
    int stride = 0;
    std::uint64_t reciprocal = 0;  ///< 2^40 / stride, rounded up: divides an index without a division.
  } rows_;
  std::int32_t goal_ = -1;
  std::int32_t start_ = -1;
  common::CellIndex start_offset_;  ///< Of the start in the rectangle.
  std::uint32_t key_offset_ = 0;    ///< k_m of the paper.
  std::uint16_t generation_ = 0;
  std::vector<CostMap::Cost> cost_;  ///< The costs that the search is based on.
  SurfaceSteps steps_;               ///< The steps that it is based on.
  std::vector<Vertex> vertices_;
  std::vector<Entry> heap_;
  std::vector<std::uint8_t> marked_;  ///< Working memory; all zero between calls.
  std::int32_t search_cost_ = 0;
  int expansions_ = 0;
};

}  // namespace swiftlet::planning
