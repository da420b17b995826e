// The state of the world at one tick, as maneuvers see it.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/disc.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "perception/people/people_tracker.hpp"
#include "planning/avoidance/avoidance.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::autonomy {

struct ManeuverInput {
  /// Up to this standard deviation the position counts as known: 95 % of such places are within 0.5 m of where they
  /// are believed to be, which is about the radius of a hull with its clearance.
  static constexpr double kKnown_m = 0.25;

  common::Time now;
  common::VehicleState state;
  std::shared_ptr<const common::OccupancyGrid> grid;  ///< Never null; a snapshot that is not written to any more.
  std::shared_ptr<const common::LevelMap> levels;     ///< May be null.
  /// Every surface that was seen below, for landing; null while no landing is wanted.
  std::shared_ptr<const common::LevelMap> surfaces;
  std::vector<common::Disc> discs;  ///< Present and predicted places of people, in `map`.
  bool anybody_walks = false;
  const planning::AvoidanceDecision& avoidance;
  /// How long it may hover before the charge is needed for the flight home and the landing; see spareTime_s.
  double spare_s = std::numeric_limits<double>::infinity();
  double drift_m = 0.0;                              ///< See DriftMonitor; up to kKnown_m the position is known.
  std::string take_off_refusal = {};                 ///< Why the vehicle must not take off; empty if it may.
  std::vector<common::DynamicObstacle> people = {};  ///< What the map does not explain, as last seen.
  const perception::SeenPoints* seen = nullptr;      ///< By the newest scan; null before the first one.
  std::shared_ptr<const std::vector<common::Polygon>> keep_out = {};  ///< Keep-out zones; null without zones.
  common::PlaceNames names = {};                                      ///< For texts.
  std::shared_ptr<const common::Map3dLayer> map3d = {};               ///< Null without an RGB-D camera.
  /// Why the sensors cannot carry a flight from where the vehicle stands; empty if they can.
  std::function<std::string()> unready = [] { return std::string(); };
  std::shared_ptr<const common::ObjectsLayer> objects = {};  ///< Recognized; null without a recognizer.

  Eigen::Vector2d position_map_m() const { return state.T_map_body_planar().position_m(); }
};

}  // namespace swiftlet::autonomy
