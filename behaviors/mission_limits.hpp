// Limits of what a mission may ask for.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"

namespace swiftlet::common {
struct TopologicalMap;
}

namespace swiftlet::behaviors {

/// Limits that the rest of the system sets to a mission.
struct MissionLimits {
  /// Why the reactive layer would not let the vehicle fly with a clearance (m, between hull and obstacle); empty if it
  /// would. Without a function every clearance is accepted.
  std::function<std::vector<common::Problem>(double clearance_m)> clearance_problems = {};
  /// Above the take-off floor; a TakeOff with `max_height_m` replaces it.
  double max_height_m = 2.0;
  /// Above the take-off floor, up to which the sensors measure the height: no TakeOff may be higher.
  double measured_height_m = std::numeric_limits<double>::infinity();
  /// Above the take-off floor, from which on they measure it: no flight may be lower.
  double least_measured_height_m = 0.0;
  /// How far the hull reaches below the plane of the laser where no camera looks.
  double unseen_below_m = 0.0;
  bool has_camera = true;  ///< The vehicle has an RGB-D camera; nodes that take pictures need one.
  /// Names of the targets that the profile looks for; nullopt: any name is accepted.
  std::optional<std::vector<std::string>> target_names = {};
  /// A map of the place is given; nodes that localize need one, or a LoadMap in the mission.
  bool has_map = true;
  /// What the mission may name as entries (place_entries.hpp); null: nothing.
  std::shared_ptr<const common::TopologicalMap> places = {};
  /// An operator says "go on" to a WaitForOperator, and gives an OperatorCommand its goals: without the page only the
  /// script of a trial does. Without an operator, a node that waits for it is a warning.
  bool operator_goes_on = true;
  bool operator_gives_goals = true;
  /// Why the map that a LoadMap in that mission file names cannot be loaded, with its place; nullopt if it can. Without
  /// a function every map is accepted.
  std::function<std::optional<common::Problem>(const std::string& map, const std::string& mission)> map_problem = {};
};

}  // namespace swiftlet::behaviors
