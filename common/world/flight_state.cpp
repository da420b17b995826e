#include "common/world/flight_state.hpp"

#include "common/check.hpp"

namespace swiftlet::common {

const char* toString(FlightState state) {
  switch (state) {
    case FlightState::kPreparation:
      return "preparation";
    case FlightState::kPoweredOff:
      return "powered off";
    case FlightState::kLanded:
      return "landed";
    case FlightState::kTakingOff:
      return "taking off";
    case FlightState::kFlying:
      return "flying";
    case FlightState::kLanding:
      return "landing";
    case FlightState::kEmergencyLanding:
      return "emergency landing";
  }
  SWIFTLET_CHECK(false, static_cast<int>(state));
}

}  // namespace swiftlet::common
