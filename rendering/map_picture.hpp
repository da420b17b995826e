// What a picture of a map shows: a value that a flight, a mapped log or a localized log fills.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/world/frontier.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::rendering {

enum class LineStyle {
  kTrail,      ///< Where the vehicle has been: broad, solid.
  kTrack,      ///< Where the sensor of a log has been: finer, solid.
  kPlan,       ///< Where the vehicle will fly: dashed, with a dot at its end.
  kReference,  ///< What the others are compared with, and what connects them: fine, dashed.
};

struct MapLine {
  /// For the legend of an SVG: "estimate", "ground truth". Lines of one name share a colour and an entry; an empty one
  /// has none.
  std::string name;
  std::vector<Eigen::Vector2d> points_map_m;
  LineStyle style = LineStyle::kTrail;
};

enum class MarkStyle { kHome, kGoal, kVehicle };

struct MapMark {
  std::string name;  ///< Written beside it in an SVG: "home", "goal".
  common::Pose2 at_map;
  MarkStyle style = MarkStyle::kHome;
  double diameter_m = 0.0;  ///< Of the vehicle's hull; the others have a size in pixels.
};

struct MapPicture {
  std::shared_ptr<const common::OccupancyGrid> grid;               ///< Never null.
  std::shared_ptr<const common::LevelMap> levels;                  ///< May be null: none.
  std::shared_ptr<const std::vector<common::Frontier>> frontiers;  ///< May be null: none.
  std::vector<Eigen::Vector2f> scan_map_m;                         ///< The end points of a scan.
  std::vector<MapLine> lines;                                      ///< The first is drawn lowest,
  std::vector<MapMark> marks;                                      ///< and so it is with the marks, over the lines.
  std::vector<Eigen::Vector2d> in_view_map_m{Eigen::Vector2d::Zero()};  ///< Shown even where nothing is known.
};

/// All that the World knows: its map, the last scan, trail and plan, home, goal and the vehicle.
MapPicture pictureOf(const common::World& world, double hull_diameter_m);

}  // namespace swiftlet::rendering
