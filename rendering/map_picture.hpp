// The content of a picture of a map. A flight, a mapped log or a localized log fills it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/world/frontier.hpp"
#include "rendering/shown_frame.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::rendering {

enum class LineStyle {
  kTrail,      ///< The flown path of the vehicle: broad, solid.
  kTrack,      ///< The path of the sensor of a log: finer, solid.
  kPlan,       ///< The planned path: dashed, with a dot at its end.
  kReference,  ///< A path to compare with, or a connection between paths: fine, dashed.
};

struct MapLine {
  /// Name in the legend of an SVG: "estimate", "ground truth". Lines of one name share a colour and an entry; an empty
  /// name has no entry.
  std::string name;
  std::vector<Eigen::Vector2d> points_map_m;
  LineStyle style = LineStyle::kTrail;
};

enum class MarkStyle { kHome, kGoal, kTarget, kCandidate, kOpen, kClosed, kVehicle };

struct MapMark {
  std::string name;  ///< Written beside the mark in an SVG: "home", "goal", "red 1".
  common::Pose2 at_map;
  MarkStyle style = MarkStyle::kHome;
  /// Diameter of the vehicle's hull, or width of an opening, which is seen along its normal; other marks have a size in
  /// pixels.
  double diameter_m = 0.0;
};

struct MapPicture {
  std::shared_ptr<const common::OccupancyGrid> grid;               ///< Never null.
  std::shared_ptr<const common::LevelMap> levels;                  ///< May be null: none.
  std::shared_ptr<const std::vector<common::Frontier>> frontiers;  ///< May be null: none.
  std::vector<Eigen::Vector2f> scan_map_m;                         ///< The end points of a scan.
  std::vector<MapLine> lines;  ///< Lines in the order of drawing; the first is the lowest.
  std::vector<MapMark> marks;  ///< Marks in the order of drawing, above the lines.
  /// The picture is upright in `map`; its metre lines and axes are those of this frame.
  ShownFrame shown;
  std::vector<Eigen::Vector2d> in_view_map_m{Eigen::Vector2d::Zero()};  ///< Points that are always shown.
};

/// The picture of a World: its map, the last scan, trail and plan, home, goal, targets, what is recognized,
/// and the vehicle.
MapPicture pictureOf(const common::World& world, double hull_diameter_m);

}  // namespace swiftlet::rendering
