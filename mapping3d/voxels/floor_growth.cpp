#include "mapping3d/voxels/floor_growth.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace swiftlet::mapping3d {
namespace {

/// What a scanner on a tripod does not see of the floor at its feet.
constexpr double kFarthestAssumed_m = 1.5;
/// Between neighbouring columns: a stair, which may be 0.2 m high, and the noise of a scan.
constexpr double kGreatestStep_m = 0.3;
/// A part of a column that begins higher above the floor is on top of a wall.
constexpr double kHighestStart_m = 2.0;

/// Free from the floor on, as no column of a wall is that has holes.
constexpr double kOpen_m = 1.0;

struct FloorColumn {
  int floor = -1;       ///< The lowest layer that is free; -1 where the floor has not been yet.
  int ceiling = -1;     ///< The layer where it ends; -1 where nothing ends it.
  int assumed = 0;      ///< Columns since a floor was measured.
  int level = -1;       ///< The floor without the noise of its points.
  bool open = false;    ///< It is free for a metre from the floor on, as in no wall.
  int carve_begin = 0;  ///< From there to the ceiling, what is unknown is free.
};

class FloorGrower {
 public:
  FloorGrower(FreeSpace& space, double hull_height_m)
      : space_(space),
        columns_(static_cast<std::size_t>(space.free.width()) * static_cast<std::size_t>(space.free.depth())),
        step_(std::max(1, layersOf(kGreatestStep_m))),
        hull_(std::max(1, layersOf(hull_height_m))),
        highest_start_(layersOf(kHighestStart_m)),
        open_(layersOf(kOpen_m)),
        most_assumed_(static_cast<int>(kFarthestAssumed_m / space.voxel_m.x())) {}

  void growFrom(int x, int y, int floor) {
    std::deque<std::pair<int, int>> open;
    const auto reach = [&](int to_x, int to_y, const FloorColumn& from) {
      if (!space_.free.contains(to_x, to_y, 0) || at(to_x, to_y).floor >= 0) return;
      const auto next = continued(to_x, to_y, from);
      if (!next) return;
      at(to_x, to_y) = *next;
      open.emplace_back(to_x, to_y);
    };
    reach(x, y, {.floor = floor});
    while (!open.empty()) {
      const auto [from_x, from_y] = open.front();
      open.pop_front();
      const FloorColumn from = at(from_x, from_y);
      reach(from_x - 1, from_y, from);
      reach(from_x + 1, from_y, from);
      reach(from_x, from_y - 1, from);
      reach(from_x, from_y + 1, from);
    }
  }

  /// A voxel that stands out of the floor around it, or is missing in it, is the noise of its points: floors within a
  /// layer of the median around them are level with it.
  void level(double radius_m) {
    const int reach = std::max(1, static_cast<int>(radius_m / space_.voxel_m.x()));
    std::vector<int> levels(columns_.size(), -1), around;
    for (int y = 0; y < space_.free.depth(); ++y) {
      for (int x = 0; x < space_.free.width(); ++x) {
        const int floor = at(x, y).floor;
        if (floor < 0) continue;
        around.clear();
        for (int j = std::max(0, y - reach); j <= std::min(space_.free.depth() - 1, y + reach); ++j)
          for (int i = std::max(0, x - reach); i <= std::min(space_.free.width() - 1, x + reach); ++i)
            if (at(i, j).floor >= 0) around.push_back(at(i, j).floor);
        const auto median = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
        std::nth_element(around.begin(), median, around.end());
        levels[numberOf(x, y)] = at(x, y).open && std::abs(*median - floor) <= 1 ? *median : floor;
      }
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].level = levels[i];
  }

  void apply() {
    BitVolume& free = space_.free;
    for (int y = 0; y < free.depth(); ++y) {
      for (int x = 0; x < free.width(); ++x) {
        const FloorColumn& column = at(x, y);
        if (column.floor >= 0) {
          for (int z = column.level; z < column.floor; ++z) free.set(x, y, z);
          for (int z = 0; z < column.level; ++z) free.clear(x, y, z);
          if (space_.open_below)
            for (int z = column.ceiling; z >= 0 && z < free.height(); ++z) free.clear(x, y, z);
          else
            for (int z = std::max(column.level, column.carve_begin); z < column.ceiling; ++z)
              if (!space_.measured.at(x, y, z)) free.set(x, y, z);
        } else if (space_.open_below) {
          for (int z = 0; z < free.height(); ++z) free.clear(x, y, z);
        }
      }
    }
    space_.open_below = false;
  }

 private:
  int layersOf(double height_m) const { return static_cast<int>(std::lround(height_m / space_.voxel_m.z())); }
  std::size_t numberOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(space_.free.width()) + static_cast<std::size_t>(x);
  }
  FloorColumn& at(int x, int y) { return columns_[numberOf(x, y)]; }

  /// The layer above the measured surface nearest to a height, within a step.
  std::optional<int> surfaceNear(int x, int y, int layer) const {
    for (int off = 0; off <= step_; ++off)
      for (const int top : {layer - off, layer + off})
        if (space_.measured.at(x, y, top - 1) && !space_.measured.at(x, y, top)) return top;
    return std::nullopt;
  }

  /// The highest layer of a column that is not free; nullopt if it is well below the ceiling that is expected.
  std::optional<int> roofOf(int x, int y, int expected) const {
    for (int z = space_.free.height() - 1; z >= std::max(0, expected - step_); --z)
      if (!space_.free.at(x, y, z)) return z;
    return std::nullopt;
  }
  /// The first measured layer from one on.
  std::optional<int> ceilingFrom(int x, int y, int layer) const {
    for (int z = layer; z < space_.measured.height(); ++z)
      if (space_.measured.at(x, y, z)) return z;
    return std::nullopt;
  }

  /// The floor in a column beside one that has it; nullopt in a wall, and too far from a measured floor.
  std::optional<FloorColumn> continued(int x, int y, const FloorColumn& from) const {
    FloorColumn column{.floor = from.floor, .assumed = from.assumed + 1};
    if (const auto surface = surfaceNear(x, y, from.floor)) column = {.floor = *surface};
    if (column.assumed > most_assumed_) return std::nullopt;
    const BitVolume &free = space_.free, &measured = space_.measured;
    bool unknown_below = true;
    for (int z = std::max(0, column.floor); z < free.height() && z - column.floor <= highest_start_; ++z) {
      if (!free.at(x, y, z)) {
        unknown_below = unknown_below && !measured.at(x, y, z);
        continue;
      }
      int end = z;
      while (free.at(x, y, end)) ++end;
      if (end - z < hull_) {
        unknown_below = false;
        z = end;
        continue;
      }
      column.carve_begin = unknown_below ? column.floor : z;
      column.open = unknown_below && end - z >= open_;
      if (space_.open_below)
        column.ceiling = roofOf(x, y, from.ceiling < 0 ? end : from.ceiling).value_or(from.ceiling);
      else
        column.ceiling = ceilingFrom(x, y, end).value_or(from.ceiling);
      return column;
    }
    return std::nullopt;
  }

  FreeSpace& space_;
  std::vector<FloorColumn> columns_;
  int step_, hull_, highest_start_, open_, most_assumed_;
};

}  // namespace

bool growFloor(FreeSpace& space, const Eigen::Vector2d& start_m, const StandingRoom& room, double hull_height_m,
               std::optional<double> height_m) {
  const auto seed = measuredFloorNear(space, start_m, room, height_m, kFarthestAssumed_m);
  if (!seed) return false;
  FloorGrower grower(space, hull_height_m);
  const Eigen::Vector3d voxel = (seed->floor_m - space.corner_m).cwiseQuotient(space.voxel_m);
  grower.growFrom(static_cast<int>(std::floor(voxel.x())), static_cast<int>(std::floor(voxel.y())),
                  static_cast<int>(std::lround(voxel.z())));
  grower.level(room.radius_m);
  grower.apply();
  return true;
}

}  // namespace swiftlet::mapping3d
