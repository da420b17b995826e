#include "autonomy/maneuvers/maneuver.hpp"

#include <fmt/format.h>

#include "autonomy/maneuvers/path_flight.hpp"

namespace swiftlet::autonomy {

Progress cannot(std::string_view purpose, const control::FlightController& controller) {
  const char* state = toString(controller.state());
  if (controller.groundedReason().empty()) return Progress::failed(fmt::format("cannot {} while {}", purpose, state));
  return Progress::failed(fmt::format("cannot {}: {} because {}", purpose, state, controller.groundedReason()));
}

Eigen::Vector2d Maneuver::wantedVelocity_map_m_s(const common::VehicleState&) const {
  return path() ? path()->wantedVelocity_map_m_s() : Eigen::Vector2d::Zero();
}

}  // namespace swiftlet::autonomy
