// The map with trajectories as one SVG picture for the report; the grid is an embedded PNG, the lines stay sharp at
// any size.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/world.hpp"

namespace swiftlet::rendering {

struct MapLine {
  /// For the legend: "estimate", "ground truth". Lines of one name share a colour and an entry; an empty one has none.
  std::string name;
  std::vector<Eigen::Vector2d> points_map_m;
  bool dashed = false;
};

struct MapMark {
  std::string name;  ///< Written beside it; "home", "goal".
  Eigen::Vector2d point_map_m = Eigen::Vector2d::Zero();
};

/// The grid, frontiers and levels of the world with the given lines and marks over it.
std::string mapSvg(const common::World& world, const std::vector<MapLine>& lines, const std::vector<MapMark>& marks,
                   int width_px = 720);

}  // namespace swiftlet::rendering
