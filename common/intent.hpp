// What a behaviour requests of the vehicle, and its status. Behaviours emit an Intent at each tick; the autonomy
// carries it out and answers with the IntentStatus of that Intent. An Intent with the previous `id` continues it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/flight_mode.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"
#include "common/pose2.hpp"

namespace swiftlet::common {

// An intent whose text names neither place nor figure has it as kText; the text of the others stands in intent.cpp.

struct TakeOffIntent {
  double height_m = 1.0;  ///< Above the take-off floor.
};
struct LandIntent {
  static constexpr const char* kText = "land";
};
/// Descend at once where it is, without the position.
struct EmergencyLandIntent {
  static constexpr const char* kText = "emergency landing";
};
/// Stop and stay.
struct HoldIntent {
  static constexpr const char* kText = "hold";
};
/// A rectangle along the axes of `map`, or of a given map.
struct MapBounds {
  Eigen::Vector2d min_named_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_named_m = Eigen::Vector2d::Zero();
  Pose2 T_map_named;  ///< The frame of its corners: the given map, or `map` itself.
  bool contains(const Eigen::Vector2d& point_map_m) const {
    const Eigen::Vector2d p = T_map_named.inverse() * point_map_m;
    return (p.array() >= min_named_m.array()).all() && (p.array() <= max_named_m.array()).all();
  }
};
struct ExploreIntent {
  static constexpr const char* kText = "explore";
  double clearance_m = 0.10;        ///< Between hull and obstacle.
  std::optional<MapBounds> bounds;  ///< Space outside is left unexplored; nullopt: no limit.
  /// Fly also to where the laser would see too little to fix the position.
  bool leave_building = false;
  FlightMode mode = FlightMode::kFast;
};
struct GoToIntent {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  /// The goal in the frame of the given map, where the mission names it there.
  std::optional<Eigen::Vector2d> goal_given_m;
  std::optional<double> height_m;  ///< Above the take-off floor; nullopt: stay at the present height.
  std::optional<double> yaw_map_rad;
  double tolerance_m = 0.05;  ///< Greatest horizontal distance at arrival.
  /// Where the goal itself is not free, a free place this near is accepted, although it is beyond the tolerance.
  double shift_m = 0.0;
  double shift_after_s = 0.0;  ///< Only after the goal has not been free for this long: a person there may go.
  double clearance_m = 0.10;   ///< Between hull and obstacle.
  FlightMode mode = FlightMode::kFast;
};
/// Where the take-off place is not free, a place this near to it is home as well; the rest is left to the controller.
inline constexpr double kHomeShift_m = 0.4;
/// Leave the vehicle to the reactive layer until the danger is over.
struct AvoidIntent {
  static constexpr const char* kText = "avoid obstacle";
};
/// Fly back along a path that was flown before, without planning.
struct RetraceIntent {
  static constexpr const char* kText = "fly back along the trail";
  std::vector<Eigen::Vector2d> path_map_m;  ///< The nearest place first; the last one is the goal.
  /// The unknown place that the vehicle wanted to see when it became uncertain of its position: exploring leaves it.
  std::optional<Eigen::Vector2d> lost_on_the_way_to_map_m;
};

/// Fly over an area in lanes, so that the sensor sees all of it.
struct SurveyIntent {
  Polygon area;
  std::optional<double> spacing_m;  ///< Greatest distance between two lanes; nullopt: from what the sensor sees.
  std::optional<double> height_m;   ///< Above the take-off floor; nullopt: stay at the present height.
  double clearance_m = 0.10;        ///< Between hull and obstacle.
  FlightMode mode = FlightMode::kFast;
};
/// Orbit a point with the camera on it, counter-clockwise.
struct InspectIntent {
  Eigen::Vector2d point_map_m = Eigen::Vector2d::Zero();
  std::optional<double> point_height_m;  ///< Above the take-off floor; nullopt: not known.
  double radius_m = 1.5;
  double turns = 1.0;
  /// Of the vehicle; nullopt: where the camera's axis meets the point, or the present height.
  std::optional<double> height_m;
  double clearance_m = 0.10;  ///< Between hull and obstacle.
  FlightMode mode = FlightMode::kFast;
};
/// Follow a walking person, or return to the one that was followed.
struct FollowIntent {
  double distance_m = 2.0;    ///< Between the vehicle's centre and the person's.
  double lost_s = 20.0;       ///< Fails when the person was not seen for this long.
  bool until_near = false;    ///< Fly to where the last person was, and end near the person.
  double clearance_m = 0.10;  ///< Between hull and obstacle.
  FlightMode mode = FlightMode::kFast;
};

/// Fly through an opening that was recognized, slowly, at the height of its middle, as it is seen from moment to
/// moment.
struct FlyThroughIntent {
  int object_id = 0;       ///< In the World's layer of objects.
  std::string what = {};   ///< `window`; for texts.
  double heading_rad = 0;  ///< In `map`, of the flight: into the wall, at most 90 deg from the opening's normal there.
  double before_m = 1.6;   ///< From the wall to the place on the opening's normal where it turns to the opening.
  double behind_m = 1.2;   ///< From the wall to the place on its other side where it ends.
  double clearance_m = 0.10;  ///< Between hull and obstacle.
};

using IntentKind =
    std::variant<HoldIntent, TakeOffIntent, LandIntent, ExploreIntent, GoToIntent, AvoidIntent, RetraceIntent,
                 EmergencyLandIntent, SurveyIntent, InspectIntent, FollowIntent, FlyThroughIntent>;

struct Intent {
  std::uint64_t id = 0;  ///< 0: no behaviour has emitted one; the vehicle holds.
  IntentKind kind;
  std::uint64_t resumes = 0;  ///< The interrupted intent that this one continues; 0: it continues no intent.
};

enum class IntentState { kRunning, kSucceeded, kFailed };

struct IntentStatus {
  std::uint64_t id = 0;
  IntentState state = IntentState::kRunning;
  std::string reason;  ///< For people: what it is doing, or why it failed.
  /// The vehicle has stopped, so that another behaviour may take it over.
  bool released = true;
  /// Of an InspectIntent: the vehicle is on its circle and has turned to the point.
  bool inspecting = false;

  bool operator==(const IntentStatus&) const = default;
};

/// Where the goal is: exactly as it was named if that was in the given map.
std::string placeOf(const GoToIntent& goal, const PlaceNames& names = {});
/// "go to (3.00, -1.50)", for events and the page.
std::string toString(const Intent& intent, const PlaceNames& names = {});

}  // namespace swiftlet::common
