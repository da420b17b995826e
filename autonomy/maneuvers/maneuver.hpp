// A maneuver carries out one intent: it is made when the intent begins and destroyed when it ends or another intent
// comes, and all its state is destroyed with it.
//
//   intent begins --> made --> step, step, answered, step ... --> done or failed --> destroyed
//                                        another intent comes -----------------------^
//
// One thread. A new maneuver is a file of its own and a line in table.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "autonomy/maneuvers/executor_config.hpp"
#include "autonomy/maneuvers/flight_memory.hpp"
#include "autonomy/maneuvers/maneuver_input.hpp"
#include "autonomy/maneuvers/planning_request.hpp"
#include "autonomy/maneuvers/progress.hpp"
#include "autonomy/maneuvers/retreat_flight.hpp"
#include "autonomy/planning_jobs/planning_desk.hpp"
#include "common/rgbd_camera_config.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

class PathFlight;

/// The objects that a maneuver uses; all of them outlive it.
struct ManeuverSetup {
  const ExecutorConfig& config;
  control::FlightController& controller;
  PlanningDesk& desk;
  const RetreatFlight& retreat;
  FlightMemory& memory;
  PlanningClient client;                             ///< The client that requests its plans.
  std::uint64_t resumes = 0;                         ///< Intent::resumes.
  const common::RgbdCameraConfig* camera = nullptr;  ///< Null without one.
};

/// The failure of a maneuver that the flight state does not allow. It names what brought the vehicle down, if that is
/// the cause: "cannot take off: landed because no valid height for 0.3 s".
Progress cannot(std::string_view purpose, const control::FlightController& controller);

class Maneuver {
 public:
  Maneuver() = default;
  Maneuver(const Maneuver&) = delete;
  Maneuver& operator=(const Maneuver&) = delete;
  virtual ~Maneuver() = default;

  /// Called at the behaviours' rate, from the tick in which the intent began. The vehicle was told to stop then (unless
  /// it retreats), and may still be moving at the first steps.
  virtual Progress step(const ManeuverInput& input) = 0;
  /// The answer to its planning request. It is not called while the reactive layer retreats, because the answer is
  /// outdated then. `state` is the newest.
  virtual Progress answered(const PlanningAnswer&, common::Time, const common::VehicleState&) { return {}; }

  /// The world of which the cost map is made while this maneuver flies.
  virtual ManeuverInput planningInput(const ManeuverInput& input) const { return input; }
  /// The place it is flying to, in `map`, for display.
  virtual std::optional<Eigen::Vector2d> goal_map_m() const { return std::nullopt; }
  /// The unknown place that it explores, in `map`.
  virtual std::optional<Eigen::Vector2d> wantsToSee_map_m() const { return std::nullopt; }
  /// Estimated place, in `map`, of the person whom it follows, or returns to.
  virtual std::optional<Eigen::Vector2d> followedPerson_map_m() const { return std::nullopt; }
  /// The path it flies; null for a maneuver without planned paths.
  virtual const PathFlight* path() const { return nullptr; }
  /// The velocity along the path it flies, in `map`; zero without a path.
  virtual Eigen::Vector2d wantedVelocity_map_m_s(const common::VehicleState&) const { return Eigen::Vector2d::Zero(); }
};

}  // namespace swiftlet::autonomy
