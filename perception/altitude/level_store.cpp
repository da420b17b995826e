#include "perception/altitude/level_store.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/check.hpp"

namespace swiftlet::perception::altitude {

using common::CellIndex;

LevelStore::LevelStore(double resolution_m) : resolution_m_(resolution_m), heads_(resolution_m, -1) {}

void LevelStore::clear() {
  levels_.clear();
  joined_into_.clear();
  entries_.clear();
  heads_ = common::TiledGrid<std::int32_t>(resolution_m_, -1);
}

int LevelStore::add(double height_m, double variance_m2) {
  const int id = static_cast<int>(levels_.size());
  LevelEstimate level;
  level.height_m = height_m;
  level.variance_m2 = variance_m2;
  levels_.push_back(std::move(level));
  joined_into_.push_back(id);
  return id;
}

bool LevelStore::extend(int level, CellIndex cell) {
  level = resolved(level);
  if (covers(level, cell)) return false;
  std::int32_t& head = heads_.mutableAt(cell);
  entries_.push_back({level, head});
  head = static_cast<std::int32_t>(entries_.size()) - 1;
  auto& cells = levels_[static_cast<std::size_t>(level)].cells;
  cells.insert(std::lower_bound(cells.begin(), cells.end(), cell), cell);
  return true;
}

void LevelStore::near(CellIndex center, double distance_m, std::vector<int>& levels) const {
  levels.clear();
  const int r = reach(distance_m);
  for (int y = center.y - r; y <= center.y + r; ++y)
    for (int x = center.x - r; x <= center.x + r; ++x)
      for (std::int32_t e = heads_.at({x, y}); e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
        const int level = resolved(entries_[static_cast<std::size_t>(e)].level);
        if (std::find(levels.begin(), levels.end(), level) == levels.end()) levels.push_back(level);
      }
  std::sort(levels.begin(), levels.end());
}

bool LevelStore::meet(int a, int b, CellIndex center, double distance_m) const {
  const int r = reach(distance_m);
  for (int y = center.y - r; y <= center.y + r; ++y)
    for (int x = center.x - r; x <= center.x + r; ++x)
      if (covers(a, {x, y}) && coversAround(b, {x, y})) return true;
  return false;
}

int LevelStore::join(int a, int b) {
  const int older = std::min(resolved(a), resolved(b)), younger = std::max(resolved(a), resolved(b));
  SWIFTLET_CHECK(older != younger, a, b);
  LevelEstimate& i = levels_[static_cast<std::size_t>(older)];
  LevelEstimate& j = levels_[static_cast<std::size_t>(younger)];
  const double sum_m2 = i.variance_m2 + j.variance_m2;
  SWIFTLET_CHECK(sum_m2 > 0.0, a, b);
  i.height_m = (j.variance_m2 * i.height_m + i.variance_m2 * j.height_m) / sum_m2;
  i.variance_m2 = i.variance_m2 * j.variance_m2 / sum_m2;
  std::vector<CellIndex> cells;
  cells.reserve(i.cells.size() + j.cells.size());
  std::set_union(i.cells.begin(), i.cells.end(), j.cells.begin(), j.cells.end(), std::back_inserter(cells));
  i.cells = std::move(cells);
  j = {};
  joined_into_[static_cast<std::size_t>(younger)] = older;
  return older;
}

common::LevelMap LevelStore::snapshot() const {
  common::LevelMap map;
  map.resolution_m = resolution_m_;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (joined_into_[i] != static_cast<int>(i)) continue;
    map.levels.push_back({static_cast<int>(i), levels_[i].height_m, levels_[i].variance_m2, levels_[i].cells});
  }
  return map;
}

int LevelStore::resolved(int level) const {
  while (joined_into_[static_cast<std::size_t>(level)] != level) level = joined_into_[static_cast<std::size_t>(level)];
  return level;
}

int LevelStore::reach(double distance_m) const { return static_cast<int>(std::lround(distance_m / resolution_m_)); }

bool LevelStore::covers(int level, CellIndex cell) const {
  level = resolved(level);
  for (std::int32_t e = heads_.at(cell); e >= 0; e = entries_[static_cast<std::size_t>(e)].next)
    if (resolved(entries_[static_cast<std::size_t>(e)].level) == level) return true;
  return false;
}

bool LevelStore::coversAround(int level, CellIndex cell) const {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (covers(level, {cell.x + dx, cell.y + dy})) return true;
  return false;
}

}  // namespace swiftlet::perception::altitude
