// Stores the levels and the cells they cover, with a grid for finding the levels near a place.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/level_map.hpp"
#include "common/tiled_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::perception::altitude {

struct LevelEstimate {
  double height_m = 0.0;
  double variance_m2 = 0.0;
  std::vector<common::CellIndex> cells;  ///< Sorted.
};

class LevelStore {
 public:
  explicit LevelStore(double resolution_m);

  void clear();
  /// Adds a level and returns its id; ids count up from 0.
  int add(double height_m, double variance_m2);
  LevelEstimate& at(int level) { return levels_[static_cast<std::size_t>(resolved(level))]; }
  const LevelEstimate& at(int level) const { return levels_[static_cast<std::size_t>(resolved(level))]; }

  common::CellIndex cellAt(const Eigen::Vector2d& position_map_m) const { return heads_.cellAt(position_map_m); }
  Eigen::Vector2d centerOf(common::CellIndex cell) const { return heads_.centerOf(cell); }
  /// Adds a cell to a level. True if the level did not cover the cell before.
  bool extend(int level, common::CellIndex cell);
  /// Finds the levels with a cell within `distance_m` of `center` (a square), in ascending order.
  void near(common::CellIndex center, double distance_m, std::vector<int>& levels) const;
  bool covers(int level, common::CellIndex cell) const;
  /// Whether the level covers the cell or one beside it.
  bool coversAround(int level, common::CellIndex cell) const;
  /// Whether cells of both levels touch within `distance_m` (a square) of `center`.
  bool meet(int a, int b, common::CellIndex center, double distance_m) const;
  /// Whether one has been joined into the other.
  bool isSame(int a, int b) const { return resolved(a) == resolved(b); }
  /// Merges both levels into the older one and returns its id: multiplies the Gaussians and unites the cells (Grzonka
  /// 2012, IV-C).
  int join(int a, int b);

  common::LevelMap snapshot() const;

 private:
  struct Entry {
    int level;
    std::int32_t next;
  };
  int resolved(int level) const;
  int reach(double distance_m) const;

  double resolution_m_;
  std::vector<LevelEstimate> levels_;
  std::vector<int> joined_into_;  ///< For each id the level it was merged into, or itself.
  std::vector<Entry> entries_;
  common::TiledGrid<std::int32_t> heads_;  ///< First entry of each cell; -1 for none.
};

}  // namespace swiftlet::perception::altitude
