// What outlives a maneuver: facts about the flight and the place. What an intent wants is not among them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/event.hpp"
#include "common/time.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::autonomy {

/// What exploring has found out about the place, so that an Explore that was interrupted does not look again where
/// looking was in vain.
struct ExplorationMemory {
  std::vector<planning::ExplorationAttempt> attempts;  ///< Until everything is explored.
  std::optional<common::Time> people_seen;             ///< When somebody walked about last.
};

struct FlightMemory {
  /// Paths are flown at this height over the take-off floor: that of the take-off until a goal names another.
  double cruise_height_m = 1.0;
  ExplorationMemory exploration;
  std::vector<common::Event> events;

  void say(common::Time now, common::Severity severity, std::string text, std::string reason = {}) {
    events.push_back({now, severity, "flight", std::move(text), std::move(reason)});
  }
};

}  // namespace swiftlet::autonomy
