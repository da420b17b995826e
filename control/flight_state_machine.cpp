#include "control/flight_state_machine.hpp"

#include <fmt/core.h>

#include "common/check.hpp"

namespace swiftlet::control {
namespace {

using common::FlightState;

struct Transition {
  FlightState from;
  FlightInput input;
  FlightState to;
};

/// The arrows of the drawing. Every other transition is refused.
constexpr Transition kTransitions[] = {
    {FlightState::kPreparation, FlightInput::kPrepared, FlightState::kPoweredOff},
    {FlightState::kPoweredOff, FlightInput::kPrepare, FlightState::kPreparation},
    {FlightState::kPoweredOff, FlightInput::kEngageMotors, FlightState::kLanded},
    {FlightState::kLanded, FlightInput::kDisengageMotors, FlightState::kPoweredOff},
    {FlightState::kLanded, FlightInput::kEmergency, FlightState::kPoweredOff},
    {FlightState::kLanded, FlightInput::kTakeOff, FlightState::kTakingOff},
    {FlightState::kTakingOff, FlightInput::kHoverReached, FlightState::kFlying},
    {FlightState::kTakingOff, FlightInput::kLand, FlightState::kLanding},
    {FlightState::kTakingOff, FlightInput::kEmergency, FlightState::kEmergencyLanding},
    {FlightState::kFlying, FlightInput::kLand, FlightState::kLanding},
    {FlightState::kFlying, FlightInput::kEmergency, FlightState::kEmergencyLanding},
    {FlightState::kLanding, FlightInput::kTouchedDown, FlightState::kLanded},
    {FlightState::kLanding, FlightInput::kEmergency, FlightState::kEmergencyLanding},
    {FlightState::kEmergencyLanding, FlightInput::kTouchedDown, FlightState::kPoweredOff},
};

}  // namespace

const char* toString(FlightInput input) {
  switch (input) {
    case FlightInput::kPrepared:
      return "prepared";
    case FlightInput::kPrepare:
      return "prepare";
    case FlightInput::kEngageMotors:
      return "engage motors";
    case FlightInput::kDisengageMotors:
      return "disengage motors";
    case FlightInput::kTakeOff:
      return "take off";
    case FlightInput::kHoverReached:
      return "hover reached";
    case FlightInput::kLand:
      return "land";
    case FlightInput::kTouchedDown:
      return "touched down";
    case FlightInput::kEmergency:
      return "emergency";
  }
  SWIFTLET_CHECK(false, static_cast<int>(input));
  return "";
}

Activation activationOf(FlightState state) {
  switch (state) {
    case FlightState::kPreparation:
      return {.fusion = false, .control = false, .waypoints = false};
    case FlightState::kPoweredOff:
    case FlightState::kLanded:
      return {.fusion = true, .control = false, .waypoints = false};
    case FlightState::kTakingOff:
    case FlightState::kLanding:
      return {.fusion = true, .control = true, .waypoints = false};
    case FlightState::kFlying:
      return {.fusion = true, .control = true, .waypoints = true};
    case FlightState::kEmergencyLanding:
      return {.fusion = false, .control = true, .waypoints = false};
  }
  SWIFTLET_CHECK(false, static_cast<int>(state));
  return {};
}

bool isAirborne(FlightState state) { return activationOf(state).control; }

tl::expected<FlightState, std::string> FlightStateMachine::apply(FlightInput input) {
  for (const Transition& transition : kTransitions)
    if (transition.from == state_ && transition.input == input) return state_ = transition.to;
  return tl::unexpected(fmt::format("{} is not possible while {}", toString(input), common::toString(state_)));
}

}  // namespace swiftlet::control
