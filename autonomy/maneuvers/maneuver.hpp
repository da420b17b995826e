// A maneuver carries out one intent: it is made when the intent begins and destroyed when it ends or another intent
// comes, and all its state goes with it.
//
//   intent begins --> made --> step, step, answered, step ... --> done or failed --> destroyed
//                                        another intent comes -----------------------^
//
// One thread. A new maneuver is a file of its own and a line in table.cpp.
#pragma once

#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "autonomy/executor_config.hpp"
#include "autonomy/maneuvers/flight_memory.hpp"
#include "autonomy/maneuvers/maneuver_input.hpp"
#include "autonomy/maneuvers/progress.hpp"
#include "autonomy/maneuvers/retreat_flight.hpp"
#include "autonomy/planning_desk.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

class PathFlight;

/// What a maneuver works with; all of it outlives the maneuver.
struct ManeuverSetup {
  const ExecutorConfig& config;
  control::FlightController& controller;
  PlanningDesk& desk;
  const RetreatFlight& retreat;
  FlightMemory& memory;
  PlanningClient client;  ///< In whose name it asks for plans.
};

/// For a maneuver that the flight state does not allow; names what brought the vehicle down, when that is why: "cannot
/// take off: landed because no valid height for 0.3 s".
Progress cannot(std::string_view purpose, const control::FlightController& controller);

class Maneuver {
 public:
  Maneuver() = default;
  Maneuver(const Maneuver&) = delete;
  Maneuver& operator=(const Maneuver&) = delete;
  virtual ~Maneuver() = default;

  /// At the behaviours' rate, from the tick on in which the intent began.
  virtual Progress step(const ManeuverInput& input) = 0;
  /// The planning it asked for is there; not called while the reactive layer retreats, as that answer is outdated.
  /// `state` is the newest.
  virtual Progress answered(const PlanningAnswer&, common::Time, const common::VehicleState&) { return {}; }

  /// Where it flies to at present, for people to see; in `map`.
  virtual std::optional<Eigen::Vector2d> goal_map_m() const { return std::nullopt; }
  /// The path it flies; null for a maneuver that flies none.
  virtual const PathFlight* path() const { return nullptr; }
};

}  // namespace swiftlet::autonomy
