// What a behaviour wants of the vehicle, and the status of that. Behaviours emit an Intent at each tick; the autonomy
// carries it out and answers with the IntentStatus of that Intent. An Intent with the previous `id` continues it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/flight_mode.hpp"

namespace swiftlet::common {

struct TakeOffIntent {
  double height_m = 1.0;  ///< Above the take-off floor.
};
struct LandIntent {};
/// Stop and stay.
struct HoldIntent {};
/// A rectangle in the `map` frame.
struct MapBounds {
  Eigen::Vector2d min_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_map_m = Eigen::Vector2d::Zero();
  bool contains(const Eigen::Vector2d& p) const {
    return (p.array() >= min_map_m.array()).all() && (p.array() <= max_map_m.array()).all();
  }
};
struct ExploreIntent {
  double clearance_m = 0.10;        ///< Between hull and obstacle.
  std::optional<MapBounds> bounds;  ///< Space outside is left unexplored; none: no limit.
  /// Fly also to where the laser would see too little to fix the position.
  bool leave_building = false;
};
struct GoToIntent {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  /// The same place in the frame of the given map, where the mission names it there.
  std::optional<Eigen::Vector2d> goal_given_m;
  std::optional<double> height_m;  ///< Above the take-off floor; none: stay at the present height.
  std::optional<double> yaw_map_rad;
  double tolerance_m = 0.05;  ///< Greatest horizontal distance at arrival.
  double clearance_m = 0.10;  ///< Between hull and obstacle.
  FlightMode mode = FlightMode::kFast;
};
/// Leave the vehicle to the reactive layer until the danger is over.
struct AvoidIntent {};
/// Fly back along a path that was flown before, without planning.
struct RetraceIntent {
  std::vector<Eigen::Vector2d> path_map_m;  ///< The nearest place first; the last one is the goal.
  /// The unknown place that the vehicle wanted to see when it became uncertain of its position: exploring leaves it.
  std::optional<Eigen::Vector2d> lost_on_the_way_to_map_m;
};

using IntentKind =
    std::variant<HoldIntent, TakeOffIntent, LandIntent, ExploreIntent, GoToIntent, AvoidIntent, RetraceIntent>;

struct Intent {
  std::uint64_t id = 0;  ///< 0: no behaviour has emitted one; the vehicle holds.
  IntentKind kind;
};

enum class IntentState { kRunning, kSucceeded, kFailed };

struct IntentStatus {
  std::uint64_t id = 0;
  IntentState state = IntentState::kRunning;
  std::string reason;  ///< For people: what it is doing, or why it failed.
  /// The vehicle has stopped, so that another behaviour may take it over.
  bool released = true;

  bool operator==(const IntentStatus&) const = default;
};

/// "go to (3.00, -1.50)", for events and the page.
std::string toString(const Intent& intent);

}  // namespace swiftlet::common
