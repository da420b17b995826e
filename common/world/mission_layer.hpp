// The World's layer of the mission: its status, the present intent and goal, and the end of the flight.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/intent.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::common {

/// How a flight ended, in words: outcome "done", with the reason.
struct FlightEnding {
  std::string outcome;
  std::string reason;

  bool operator==(const FlightEnding&) const = default;
};

struct MissionLayer {
  MissionStatus status;
  IntentStatus intent;
  std::optional<Eigen::Vector2d> goal_map_m;  ///< Set to that of `waiting` while the mission is held.
  std::optional<FlightEnding> ending;         ///< Only in the last snapshot of a flight.
  std::string waiting;  ///< While the mission is held: the operator's command that it flies next; else empty.

  bool operator==(const MissionLayer&) const = default;
};

}  // namespace swiftlet::common
