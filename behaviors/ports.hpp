// Ports that several behaviours share, so that they mean the same in all of them.
#pragma once

#include "behaviors/tree/port.hpp"
#include "common/flight_mode.hpp"

namespace swiftlet::behaviors {

inline tree::PortManifest clearancePort() {
  return {.name = "clearance_m",
          .type = tree::PortType::kDouble,
          .default_value = "0.10",
          .minimum = 0.0,
          .maximum = 5.0,
          .description = "Between the hull and what is in the map."};
}

inline tree::PortManifest tolerancePort() {
  return {.name = "tolerance_m",
          .type = tree::PortType::kDouble,
          .default_value = "0.05",
          .minimum = 0.01,
          .maximum = 5.0,
          .description = "Arrived when nearer to the goal than this."};
}

inline tree::PortManifest modePort() {
  return {.name = "mode",
          .type = tree::PortType::kString,
          .default_value = "fast",
          .description = "How fast and how closely the path is flown.",
          .choices = {"fast", "careful", "accurate"}};
}

/// The mode of a text that fits modePort().
inline common::FlightMode flightModeOf(const std::string& text) {
  using common::FlightMode;
  if (text == "careful") return FlightMode::kCareful;
  return text == "accurate" ? FlightMode::kAccurate : FlightMode::kFast;
}

}  // namespace swiftlet::behaviors
