// The states of the flight state machine.
#pragma once

namespace swiftlet::common {

/// Table 1 and Fig. 3 of Tomic 2012.
enum class FlightState { kPreparation, kPoweredOff, kLanded, kTakingOff, kFlying, kLanding, kEmergencyLanding };
const char* toString(FlightState state);

}  // namespace swiftlet::common
