// What outlives a maneuver: facts about the flight and the place, but not the goal of an intent.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/event_log.hpp"
#include "common/time.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::autonomy {

/// Results of exploring, so that an Explore that was interrupted does not look again from viewpoints that showed
/// nothing new.
struct ExplorationMemory {
  std::vector<planning::ExplorationAttempt> attempts;  ///< Kept until everything is explored.
  std::optional<common::Time> people_seen;             ///< When a moving person was last seen.
  std::vector<Eigen::Vector2d> lost_map_m;             ///< Targets during whose approach the position became uncertain.
};

class PersonWatch;

/// The followed person, so that a Follow that was interrupted, by avoiding an obstacle for example, keeps that
/// person.
struct FollowMemory {
  std::shared_ptr<PersonWatch> person;  ///< Null: no person yet.
  common::Time watched;                 ///< When it was last updated.
};

struct TourState;

struct FlightMemory {
  explicit FlightMemory(common::EventLog& events) : log(events) {}

  common::EventLog& log;
  /// Height of paths over the take-off floor: the height of the take-off until a goal names another.
  double cruise_height_m = 1.0;
  /// The lower height of the plan that leads below something; nullopt once the vehicle is back at the height of paths.
  std::optional<double> lowered_m;
  /// Where the vehicle flew lower, and how high over the take-off floor: a flight back along the trail flies there as
  /// low.
  std::vector<Eigen::Vector3d> lowered_map_m;
  /// Where the vehicle stood before it last took off: there it can stand again. nullopt where the position was unknown.
  std::optional<Eigen::Vector2d> stood_map_m;
  bool told_laser_alone = false;  ///< An event has said that a laser cannot know whether there is room below.
  ExplorationMemory exploration;
  FollowMemory follow;
  std::vector<std::shared_ptr<TourState>> tours;  ///< Those that have not ended, see Tour; the newest last.
  std::optional<Eigen::Vector2d> person_map_m;    ///< Last estimated place of the person who is, or was, followed.

  void say(common::Time now, common::Severity severity, std::string text, std::string reason = {}) {
    log.add({now, severity, "flight", std::move(text), std::move(reason)});
  }
};

}  // namespace swiftlet::autonomy
