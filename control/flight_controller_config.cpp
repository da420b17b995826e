// The configuration of the flight controller.
#include "common/config_fields.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::control {

void FlightController::Config::describe(common::config::Fields& fields) {
  fields("climb_m_s", climb_m_s, {0.05, 3}, "Climb speed when taking off.");
  fields("descent_m_s", descent_m_s, {0.05, 3}, "Descent speed when landing.");
  fields.section("path", path, "References from paths.");
  fields.section("position", position, "Settings of the controller swiftlet, and the thrust model of all.");
  fields.section("controller", controller, "Which controller flies, and the settings of the others.");
  fields.section("clearance", clearance, "The height over what paths lead across.");
}

}  // namespace swiftlet::control
