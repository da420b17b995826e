// What outlives a maneuver: facts about the flight and the place, but not the goal of an intent.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "autonomy/planning_jobs/planning_request.hpp"
#include "common/event_log.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"
#include "control/flight_controller.hpp"
#include "perception/people/person_watch.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {

struct TourState;

/// The source of the maneuvers' events.
inline constexpr const char* kFlightSource = "flight";

struct FlightMemory {
  explicit FlightMemory(common::EventLog& events) : log(events) {}

  common::EventLog& log;
  /// Height of paths over the take-off floor: the height of the take-off until a goal names another.
  double cruise_height_m = 1.0;
  /// A plan in space is flown, and until the vehicle is back at the height of paths after it.
  bool in_space = false;
  /// Where the vehicle flew at another height than that of paths, z over the take-off floor: a flight back along the
  /// trail flies there at that height.
  std::vector<Eigen::Vector3d> other_heights_map_m;
  /// Where the vehicle stood before it last took off: there it can stand again. nullopt where the position was unknown.
  std::optional<Eigen::Vector2d> stood_map_m;
  bool told_laser_alone = false;  ///< An event has said that a laser cannot know whether there is room below.
  /// Viewpoints that showed nothing new, so that an Explore that was interrupted does not look again from them; kept
  /// until everything is explored.
  std::vector<planning::ExplorationAttempt> attempts;
  std::vector<Eigen::Vector2d> lost_map_m;  ///< Targets of exploring on whose way the position became uncertain.
  std::optional<common::Time> people_seen;  ///< When a moving person was last seen.
  /// The followed person, so that a Follow that was interrupted, by avoiding an obstacle for example, keeps that
  /// person; null: nobody yet.
  std::shared_ptr<perception::PersonWatch> person;
  common::Time person_watched;                    ///< When `person` was last updated.
  std::vector<std::shared_ptr<TourState>> tours;  ///< Those that have not ended, see Tour; the newest last.
  std::optional<Eigen::Vector2d> person_map_m;    ///< Last estimated place of the person who is, or was, followed.
};

/// The heights now: of paths, of the controller's reference, and whether a plan in space is flown.
FlightHeights heightsOf(const FlightMemory& memory, const control::FlightController& controller);

/// How much lower than its paths' height the vehicle is to be, on a path in space and until it is back; negative above.
double dip_m(const FlightMemory& memory, const control::FlightController& controller);

/// Remembers where it flies at another height. `plan` is the plan that is flown; null without one.
void rememberHeights(FlightMemory& memory, const planning::Path* plan, const control::FlightController& controller,
                     const common::VehicleState& state);

}  // namespace swiftlet::autonomy
