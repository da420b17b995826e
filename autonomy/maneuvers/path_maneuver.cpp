#include "autonomy/maneuvers/path_maneuver.hpp"

#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {

PathManeuver::PathManeuver(const ManeuverSetup& setup, std::string purpose, common::FlightMode mode)
    : setup_(setup), flight_(setup, mode), purpose_(std::move(purpose)) {}

Progress PathManeuver::step(const ManeuverInput& input) {
  if (setup_.controller.state() != common::FlightState::kFlying) return cannot(purpose_, setup_.controller);
  watch(input);
  if (setup_.retreat.active()) return Progress::running();
  // Nothing is reached, and nothing is out of reach, from a place that is not known.
  if (!input.state.horizontal_valid) return Progress::running("the position is not known");
  Progress progress = fly(input);
  if (progress.state == common::IntentState::kFailed) progress.reason = doubt(input.drift_m) + progress.reason;
  return progress;
}

/// An error of the position can close a door in the map, so the planner's reason would blame the goal.
std::string PathManeuver::doubt(double drift_m) {
  return drift_m <= ManeuverInput::kKnown_m ? std::string()
                                            : fmt::format("the position is uncertain by {:.1f} m: ", drift_m);
}

}  // namespace swiftlet::autonomy
