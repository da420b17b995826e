// The cells of the tables of trials.
#pragma once

#include <string>

#include <fmt/format.h>

#include "evaluation/flight_score.hpp"

namespace swiftlet::evaluation {

/// "7", or "7 beta" of several vehicles.
inline std::string flightName(const FlightScore& flight) {
  return fmt::format("{}{}{}", flight.seed, flight.vehicle.empty() ? "" : " ", flight.vehicle);
}

/// "collision (struck): touched `walker_0`", of a flight that ended in one.
inline std::string collisionText(const FlightScore& flight) {
  return fmt::format("collision ({}): {}", toString(flight.verdict), flight.collision);
}

}  // namespace swiftlet::evaluation
