// The gains of a controller as a list of numbers: what a search may change.
#pragma once

#include <string>
#include <vector>

#include "common/config_fields.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::control {

/// A setting of the controller that flies.
struct Gain {
  std::string name;  ///< As in a profile, below the section of the controller: "horizontal_p_1_s2".
  double value = 0.0;
  common::config::Bounds bounds{0.0, 0.0};
};

/// The section of a profile that holds the gains of `kind`, below autonomy.control: "controller.lqr".
std::string sectionOfGains(ControllerKind kind);

/// The gains of the controller that `config` chooses, in the order in which they are described. Those that are 0 are
/// switched off and are left out.
std::vector<Gain> gainsOf(const FlightController::Config& config);

/// `config` with the values of `gains`, each of which must be one of gainsOf(config).
FlightController::Config withGains(FlightController::Config config, const std::vector<Gain>& gains);

}  // namespace swiftlet::control
