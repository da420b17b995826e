#include "autonomy/maneuvers/maneuver.hpp"

#include <fmt/format.h>

namespace swiftlet::autonomy {

Progress cannot(std::string_view purpose, const control::FlightController& controller) {
  const char* state = toString(controller.state());
  if (controller.groundedReason().empty()) return Progress::failed(fmt::format("cannot {} while {}", purpose, state));
  return Progress::failed(fmt::format("cannot {}: {} because {}", purpose, state, controller.groundedReason()));
}

}  // namespace swiftlet::autonomy
