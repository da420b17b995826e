// A maneuver carries out one intent: it is made when the intent begins and destroyed when it ends or another intent
// comes, and all its state is destroyed with it.
//
//   intent begins --> made --> step, step, answered, step ... --> done or failed --> destroyed
//                                        another intent comes -----------------------^
//
// One thread. A new maneuver is a source of its own and a line in table.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include "autonomy/maneuvers/executor_config.hpp"
#include "autonomy/maneuvers/flight_memory.hpp"
#include "autonomy/maneuvers/maneuver_input.hpp"
#include "autonomy/maneuvers/retreat_flight.hpp"
#include "autonomy/planning_jobs/planning_desk.hpp"
#include "common/intent.hpp"
#include "common/rgbd_camera_config.hpp"
#include "control/flight_controller.hpp"
#include "perception/people/person_watch.hpp"

namespace swiftlet::autonomy {

class PathFlight;

/// The intent for which a plan is requested.
struct PlanningClient {
  std::uint64_t intent_id = 0;
  double clearance_m = 0.0;  ///< Between hull and obstacle; the cost map is computed for it.
};

/// A request to the planning in the world that a maneuver sees. Without a question it only updates the cost map. The
/// radius of the hull is left to the desk. The person is left out of that world; null: nobody is.
PlanningRequest planningRequest(const ManeuverInput& input, const PlanningClient& client,
                                PlanningQuestion question = {}, const perception::PersonWatch* left_out = nullptr);

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

/// The status of a maneuver after a step: running, done, or failed with a reason.
struct Progress {
  common::IntentState state = common::IntentState::kRunning;
  /// For people: what it does or waits for, what it reached, or why it failed. If it is empty while running, the last
  /// reason stays.
  std::string reason;
  bool inspecting = false;  ///< See IntentStatus; with an empty reason the last one stays.

  static Progress running(std::string reason = {}) { return {common::IntentState::kRunning, std::move(reason), false}; }
  static Progress done(std::string reason) { return {common::IntentState::kSucceeded, std::move(reason), false}; }
  static Progress failed(std::string reason) { return {common::IntentState::kFailed, std::move(reason), false}; }
};

/// What a maneuver is after, for display and for the layers below it.
struct Aim {
  std::optional<Eigen::Vector2d> goal_map_m;          ///< The place it is flying to.
  std::optional<Eigen::Vector2d> wants_to_see_map_m;  ///< The unknown place that it explores.
  std::optional<Eigen::Vector2d> person_map_m;        ///< Estimated place of the person whom it follows, or returns to.
  /// The person whom planning leaves out while this maneuver flies; null: nobody. Lives as long as the maneuver.
  const perception::PersonWatch* left_out = nullptr;
  const PathFlight* flight = nullptr;  ///< Flies its planned paths; null without any. Lives as long as the maneuver.
  Eigen::Vector2d velocity_map_m_s = Eigen::Vector2d::Zero();  ///< Along the path it flies; zero without a path.
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

  /// `state` is the newest.
  virtual Aim aim(const common::VehicleState&) const { return {}; }
};

}  // namespace swiftlet::autonomy
