// What a maneuver does while there is no path to where it wants to be: it goes nearer to look at what stands there, or
// aside so that somebody who stands in the way can pass.
#pragma once

#include <optional>
#include <string>

#include "autonomy/maneuvers/path_flight.hpp"

namespace swiftlet::autonomy {

/// One thread.
///
///            ask, then begin with the answer
///   waiting ---------------------------------> active: its path is flown, the maneuver asks for its own from time to
///     ^      there (endWhenOver), too long        time
///     |      (endWhenOver), no path left,         |
///     |      or a path was found (breakOff)       |
///     +-------------------------------------------+
class Detour {
 public:
  /// How often a maneuver asks for its own path while a detour is flown.
  static constexpr double kAskAgain_s = 1.0;

  /// The maneuver's own flight, which the detour borrows.
  Detour(const ManeuverSetup& setup, PathFlight& flight);

  bool active() const { return active_; }
  /// Without a path since then, nothing flown, and the last detour ended (or was asked for) long enough ago.
  bool due(common::Time stuck_since, common::Time now) const;
  void ask(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m);
  /// `reason`: why there is no path.
  void begin(const DetourPlan& plan, std::string reason, common::Time now, const common::VehicleState& state);
  /// Once a tick: stops when it is there, when it took too long, or when its path is gone.
  void endWhenOver(const ManeuverInput& input);
  /// A path was found: the vehicle flies on, and whatever is offered next is flown.
  void breakOff();

 private:
  const ExecutorConfig& config_;
  FlightMemory& memory_;
  PathFlight& flight_;
  bool active_ = false;
  std::optional<common::Time> since_;  ///< When the last one was asked for, or ended.
};

}  // namespace swiftlet::autonomy
