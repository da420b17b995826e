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
///     ^      there, or no path left               time
///     |      (endWhenOver),                       |
///     |      or a path was found (breakOff)       |
///     +-------------------------------------------+
class Detour {
 public:
  /// `flight` is the maneuver's own flight, which the detour borrows.
  Detour(const ManeuverSetup& setup, PathFlight& flight);

  bool active() const { return active_; }
  /// Whether a detour is due: there has been no path and no flight since then, and the last detour ended (or was
  /// requested) long enough ago. To wait for what may go, one is enough, and one for each that is in the way
  /// elsewhere; what will not go is looked at from two places. `blocked_map_m` is where something that may go stands;
  /// nullopt if nothing does.
  bool due(common::Time stuck_since, common::Time now, const std::optional<Eigen::Vector2d>& blocked_map_m) const;
  void ask(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m,
           const std::optional<Eigen::Vector2d>& blocked_map_m);
  /// `reason` says why there is no path. Returns the progress meanwhile: "detour: moves closer to look".
  Progress begin(const DetourPlan& plan, std::string reason, common::Time now, const common::VehicleState& state);
  /// Call it once a tick. Stops when the detour has arrived, or lost its path.
  void endWhenOver(const ManeuverInput& input);
  /// A path was found: the vehicle flies on, and the next plan that is offered is flown.
  void breakOff();

 private:
  const ExecutorConfig& config_;
  FlightMemory& memory_;
  PathFlight& flight_;
  bool active_ = false;
  int asked_ = 0;                                 ///< Since the last path of the maneuver's own.
  std::optional<common::Time> since_;             ///< When the last detour was requested, or ended.
  std::optional<Eigen::Vector2d> blocked_map_m_;  ///< That it was requested for.
};

}  // namespace swiftlet::autonomy
