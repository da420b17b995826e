// What a maneuver does while there is no path to its goal: it moves nearer to look at the blockage, or aside so that a
// person in the path can pass.
#pragma once

#include <optional>
#include <string>

#include "autonomy/maneuvers/path_flight.hpp"

namespace swiftlet::autonomy {

/// A viewpoint, or the end of a detour, counts as reached at this distance.
inline constexpr double kViewpointTolerance_m = 0.15;

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
  /// Period at which a maneuver asks for its own path while a detour is flown (docs/decisions/planning.md#005).
  static constexpr double kAskAgain_s = 1.0;

  /// `flight` is the maneuver's own flight, which the detour borrows.
  Detour(const ManeuverSetup& setup, PathFlight& flight);

  bool active() const { return active_; }
  /// Whether a detour is due: there has been no path and no flight since then, and the last detour ended (or was
  /// requested) long enough ago.
  bool due(common::Time stuck_since, common::Time now) const;
  void ask(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m);
  /// `reason` says why there is no path. Returns the progress meanwhile: "detour: moves closer to look".
  Progress begin(const DetourPlan& plan, std::string reason, common::Time now, const common::VehicleState& state);
  /// Call it once a tick. Stops when the detour has arrived, took too long, or lost its path.
  void endWhenOver(const ManeuverInput& input);
  /// A path was found: the vehicle flies on, and the next plan that is offered is flown.
  void breakOff();

 private:
  const ExecutorConfig& config_;
  FlightMemory& memory_;
  PathFlight& flight_;
  bool active_ = false;
  std::optional<common::Time> since_;  ///< When the last detour was requested, or ended.
};

}  // namespace swiftlet::autonomy
