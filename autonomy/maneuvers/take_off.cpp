#include "autonomy/maneuvers/take_off.hpp"

namespace swiftlet::autonomy {

using common::FlightState;

TakeOff::TakeOff(const common::TakeOffIntent& intent, const ManeuverSetup& setup) : controller_(setup.controller) {
  if (controller_.state() == FlightState::kFlying || controller_.state() == FlightState::kTakingOff) return;
  setup.memory.cruise_height_m = intent.height_m;
  commanded_ = controller_.command(control::TakeOff{intent.height_m});
}

Progress TakeOff::step(const ManeuverInput&) {
  if (!commanded_)
    return control::isAirborne(controller_.state()) ? cannot("take off", controller_)
                                                    : Progress::failed(commanded_.error());
  switch (controller_.state()) {
    case FlightState::kFlying:
      return Progress::done("at the take-off height");
    case FlightState::kTakingOff:
    case FlightState::kLanded:
      return Progress::running();
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
    case FlightState::kLanding:
    case FlightState::kEmergencyLanding:
      break;
  }
  return cannot("take off", controller_);
}

}  // namespace swiftlet::autonomy
