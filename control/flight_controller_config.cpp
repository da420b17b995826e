// The configuration of the flight controller.
#include "common/config_fields.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::control {

using common::config::kPositive;

void FlightController::Config::describe(common::config::Fields& fields) {
  fields("spool_up_s", spool_up_s, {0.05, 10}, "Time from starting the motors to lifting.");
  fields("climb_m_s", climb_m_s, {0.05, 3}, "Climb speed when taking off.");
  fields("descent_m_s", descent_m_s, {0.05, 3}, "Descent speed when landing.");
  fields("touchdown_descent_m_s", touchdown_descent_m_s, {0.05, 3}, "Descent speed near the ground.");
  fields("touchdown_height_m", touchdown_height_m, {0, 5},
         "Height over what is below at which the ground counts as near.");
  fields("take_off_timeout_s", take_off_timeout_s, kPositive,
         "Without hovering this long after the climb should have ended the vehicle lands again.");
  fields("climb_acceleration_m_s2", climb_acceleration_m_s2, {0.05, 5},
         "Vertical acceleration of taking off and landing.");
  fields("hover_tolerance_m", hover_tolerance_m, kPositive, "Taking off ends this close to the height.");
  fields("hover_speed_m_s", hover_speed_m_s, kPositive, "Taking off ends only when the vehicle is slower than this.");
  fields("hover_s", hover_s, {0, 10}, "Taking off ends when the vehicle has been close and slow for this long.");
  fields("touchdown_thrust", touchdown_thrust, {0.1, 0.99},
         "Below this share of the hover command the ground carries the vehicle.");
  fields("touchdown_s", touchdown_s, {0, 10}, "The vehicle has landed when the ground has carried it for this long.");
  fields("stopped_speed_m_s", stopped_speed_m_s, kPositive, "Slower than this the vehicle has stopped.");
  fields("horizontal_loss_s", horizontal_loss_s, kPositive,
         "Without a horizontal estimate for this long the vehicle lands level.");
  fields("blind_speed_m_s", blind_speed_m_s, {0.05, 1.0},
         "Speed at which a vehicle that has lost its horizontal estimate leaves the walls, by its velocity alone.");
  fields("blind_acceleration_m_s2", blind_acceleration_m_s2, {0.1, 3.0}, "Acceleration to blind_speed_m_s.");
  fields("blind_s", blind_s, {0, 10},
         "Longest flight by the velocity alone after the horizontal estimate was lost: a carried velocity that is off "
         "by 0.1 m/s leads 0.2 m astray in 2 s.");
  fields("vertical_loss_s", vertical_loss_s, kPositive,
         "Without a vertical estimate for this long the emergency descent begins.");
  fields("inertial_age_s", inertial_age_s, kPositive,
         "An estimate whose newest inertial sample is older than this cannot be used.");
  fields("inertial_loss_s", inertial_loss_s, kPositive,
         "The emergency descent begins when inertial samples that cannot be used have been noticed for this long.");
  fields.section("margin", margin, "How speeds and accelerations shrink with the thrust that is left.");
  fields.section("path", path, "References from paths.");
  fields.section("position", position, "Settings of the controller swiftlet, and the thrust model of all.");
  fields.section("controller", controller, "Which controller flies, and the settings of the others.");
  fields.section("clearance", clearance, "The height over what paths lead across.");
  fields.section("oscillation", oscillation, "Horizontal gains of the controller swiftlet while roll and pitch swing.");
  fields.section("emergency", emergency, "Emergency descent.");
}

}  // namespace swiftlet::control
