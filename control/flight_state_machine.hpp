// When fusion, control and waypoints are active (Tomic 2012, Fig. 3 and Table 1).
#pragma once

#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "common/world/flight_state.hpp"

namespace swiftlet::control {

/// Inputs of the machine: requests, and conditions that the flight controller detects.
enum class FlightInput {
  kPrepared,         ///< The vehicle stands at its start and will not be carried any more.
  kPrepare,          ///< The vehicle will be carried elsewhere.
  kEngageMotors,     //
  kDisengageMotors,  //
  kTakeOff,          //
  kHoverReached,     ///< Condition: at the take-off height within the stated accuracy.
  kLand,             //
  kTouchedDown,      ///< Condition: on the ground.
  kEmergency,        ///< The fusion diverged, or an emergency landing was requested.
};
const char* toString(FlightInput input);

/// The columns of Table 1.
struct Activation {
  bool fusion = false;
  bool control = false;
  bool waypoints = false;
  bool operator==(const Activation&) const = default;
};
Activation activationOf(common::FlightState state);

/// In the air or about to lift off: an emergency applies.
bool isAirborne(common::FlightState state);

/// ```
///                    prepared                 engage motors
///   +-------------+ ----------> +-------------+ ----------> +-- powered on ---------------------------------+
///   | preparation |             | powered off |             |  +--------+  take off   +------------+        |
///   +-------------+ <---------- +-------------+ <---------- |  | landed | ----------> | taking off |        |
///                    prepare      ^            disengage or |  +--------+             +------------+        |
///                                 |            emergency    |    ^                      |        |          |
///                                 |                         |    | touched down   hover |        | land     |
///                                 |                         |    |               reached|        v          |
///                                 |                         |  +---------+     +--------v-+   (to landing)  |
///                                 | touched down            |  | landing | <-- |  flying  |                 |
///                                 |                         |  +---------+land +----------+                 |
///                                 |                         +-----|---- emergency from any in the air ------+
///                                 |                               v
///                                 |                    +-------------------+
///                                 +------------------- | emergency landing |
///                                                      +-------------------+
/// ```
/// Everything else is refused with a reason and changes nothing. An emergency landing ends only by touching down, with
/// the motors off. Plain data, one thread.
class FlightStateMachine {
 public:
  common::FlightState state() const { return state_; }
  Activation activation() const { return activationOf(state_); }

  /// The new state, or why the input is refused.
  tl::expected<common::FlightState, std::string> apply(FlightInput input);

 private:
  common::FlightState state_ = common::FlightState::kPreparation;
};

}  // namespace swiftlet::control
