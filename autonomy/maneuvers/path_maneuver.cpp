#include "autonomy/maneuvers/path_maneuver.hpp"

#include <utility>

namespace swiftlet::autonomy {

PathManeuver::PathManeuver(const ManeuverSetup& setup, std::string purpose, common::FlightMode mode)
    : setup_(setup), flight_(setup, mode), purpose_(std::move(purpose)) {}

Progress PathManeuver::step(const ManeuverInput& input) {
  if (setup_.controller.state() != common::FlightState::kFlying) return cannot(purpose_, setup_.controller);
  return setup_.retreat.active() ? Progress::running() : fly(input);
}

}  // namespace swiftlet::autonomy
