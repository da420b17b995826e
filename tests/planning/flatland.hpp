// A flat world with an ideal vehicle and scanner, to test exploration: rooms with doors, boxes with pockets behind
// them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/random.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::planning::test {

/// The truth, in cells of 5 cm; the vehicle starts at the origin of `map`.
struct Flatland {
  static constexpr double kResolution_m = 0.05;
  int width = 0;
  int height = 0;
  common::CellIndex start;  ///< In cells of the truth.
  std::vector<bool> walls;
  std::vector<common::CellRect> black;  ///< Walls in here return no beam: places in front of them stay unknown.

  bool occupied(int x, int y) const {
    return x < 0 || y < 0 || x >= width || y >= height || walls[static_cast<std::size_t>(y) * width + x];
  }
  /// The cell of a point in `map`.
  bool occupiedAt(const Eigen::Vector2d& point_map_m) const;
  common::CellIndex toMap(common::CellIndex truth) const { return {truth.x - start.x, truth.y - start.y}; }
  void block(int x0, int y0, int w, int h);
  void open(int x0, int y0, int w, int h);
};

/// An outer wall, `rooms_x` by `rooms_y` rooms with doors of 0.9 to 1.2 m that connect them all, and boxes.
Flatland randomBuilding(std::uint64_t seed, double width_m, double height_m, int rooms_x, int rooms_y, int boxes);
/// 12.2 m by 7.76 m (94.7 m2) with two boxes that hide pockets, as the case of Saeedi, section IV.
Flatland pocketRoom(std::uint64_t seed);

struct FlightConfig {
  ExplorerConfig explorer;
  Footprint footprint;
  CostMap::Config cost_map;
  double speed_m_s = 0.8;
  double acceleration_m_s2 = 0.8;
  double yaw_rate_rad_s = 1.2;
  double range_m = 30.0;
  int beams = 1081;
  double dropout_rate = 0.01;
  double limit_s = 1500.0;
};

struct FlightReport {
  bool done = false;
  double time_s = 0.0;
  double length_m = 0.0;
  double coverage = 0.0;  ///< Share of the free space around places the hull can reach that became known.
  int calls = 0;
  int switches = 0;  ///< Times the viewpoint was left before it was reached while its frontier was still open.
  bool touched = false;
  ExplorationResult last;
  common::OccupancyGrid grid = common::makeOccupancyGrid(Flatland::kResolution_m);
  std::vector<Eigen::Vector2d> trail_map_m;
};

/// Flies until the explorer says done or the time is up; the wavefront plans the paths.
FlightReport fly(const Flatland& world, const FlightConfig& config, std::uint64_t seed);

}  // namespace swiftlet::planning::test
