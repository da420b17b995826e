// What is asked of the planning job, with the world in which it plans.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "common/disc.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"
#include "common/world/map3d_layer.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::autonomy {

/// The heights at the time of a path request.
struct FlightHeights {
  double cruise_m = 1.0;     ///< The height of flight, over the take-off floor.
  double reference_m = 1.0;  ///< Reference height of the controller.
  double highest_m = 2.0;    ///< No path leads higher.
  /// A plan in space is flown, or the vehicle is not yet back at the height of flight after one.
  bool in_space = false;

  /// The vehicle is at another height than its paths in the plane.
  bool isOff() const {
    constexpr double kSame_m = 0.10;  // More than a hover sways.
    return in_space && std::abs(reference_m - cruise_m) > kSame_m;
  }
};

struct GoalRequest {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  double tolerance_m = 0.0;  ///< If the goal is not free, a free place within 0.8 of it may replace the goal.
  /// If the goal is not free, a free place this near may replace it, even beyond the tolerance.
  double shift_m = 0.0;
  FlightHeights height = {};
};
struct ExploreRequest {
  std::optional<planning::Viewpoint> current;
  std::vector<planning::ExplorationAttempt> attempts;
  std::optional<common::MapBounds> bounds;
  std::vector<Eigen::Vector2d> lost_map_m = {};
  bool leave_building = false;
};
/// Asks for a place to wait at while there is no path to a goal. If something that may go blocks the path, it is a wide
/// place that sees it, so that a person can pass. Otherwise it is the last free place before the blockage, to see
/// whether the mapped obstacle is still there; if that is too near, it is a wide place, too.
struct DetourRequest {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> blocked_map_m = std::nullopt;  ///< Blockage::place_map_m, if there is one.
  bool moved_aside = false;  ///< It waits aside already, and moves only to see the blockage much better.
};

/// std::monostate requests only an update of the cost map.
using PlanningQuestion = std::variant<std::monostate, GoalRequest, DetourRequest, ExploreRequest>;

struct PlanningRequest {
  std::uint64_t intent_id = 0;
  std::shared_ptr<const common::OccupancyGrid> grid;
  std::shared_ptr<const common::LevelMap> levels;
  std::vector<common::Disc> discs;
  std::vector<common::DynamicObstacle> people;
  std::shared_ptr<const std::vector<common::Polygon>> keep_out;  ///< Null without zones.
  planning::Footprint footprint;
  std::shared_ptr<const common::Map3dLayer> map3d;  ///< Null without one: paths then keep their height.
  common::PlaceNames names;                         ///< For the texts of the answer.
  common::Pose2 T_map_body;
  PlanningQuestion question;
};

}  // namespace swiftlet::autonomy
