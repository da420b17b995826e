// Tomic 2012, Fig. 3 and Table 1, arrow by arrow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <set>

#include "control/flight_state_machine.hpp"

namespace swiftlet::control {
namespace {

using common::FlightState;
using Path = std::vector<FlightInput>;

constexpr FlightState kStates[] = {FlightState::kPreparation,     FlightState::kPoweredOff, FlightState::kLanded,
                                   FlightState::kTakingOff,       FlightState::kFlying,     FlightState::kLanding,
                                   FlightState::kEmergencyLanding};
constexpr FlightInput kInputs[] = {FlightInput::kPrepared,        FlightInput::kPrepare,     FlightInput::kEngageMotors,
                                   FlightInput::kDisengageMotors, FlightInput::kTakeOff,     FlightInput::kLand,
                                   FlightInput::kHoverReached,    FlightInput::kTouchedDown, FlightInput::kEmergency};

FlightStateMachine after(const Path& path) {
  FlightStateMachine machine;
  for (const FlightInput input : path) EXPECT_TRUE(machine.apply(input)) << toString(input);
  return machine;
}

/// Every state with a shortest path to it.
std::map<FlightState, Path> reachable() {
  std::map<FlightState, Path> paths{{FlightState::kPreparation, {}}};
  std::deque<FlightState> open{FlightState::kPreparation};
  while (!open.empty()) {
    const Path path = paths.at(open.front());
    open.pop_front();
    for (const FlightInput input : kInputs) {
      FlightStateMachine machine = after(path);
      const auto result = machine.apply(input);
      if (!result || paths.contains(*result)) continue;
      Path longer = path;
      longer.push_back(input);
      paths.emplace(*result, longer);
      open.push_back(*result);
    }
  }
  return paths;
}

TEST(FlightStateMachine, FollowsAnOrdinaryFlight) {
  FlightStateMachine machine;
  const std::pair<FlightInput, FlightState> story[] = {{FlightInput::kPrepared, FlightState::kPoweredOff},
                                                       {FlightInput::kEngageMotors, FlightState::kLanded},
                                                       {FlightInput::kTakeOff, FlightState::kTakingOff},
                                                       {FlightInput::kHoverReached, FlightState::kFlying},
                                                       {FlightInput::kLand, FlightState::kLanding},
                                                       {FlightInput::kTouchedDown, FlightState::kLanded},
                                                       {FlightInput::kDisengageMotors, FlightState::kPoweredOff}};
  for (const auto& [input, state] : story) EXPECT_EQ(machine.apply(input).value(), state);
}

TEST(FlightStateMachine, HasExactlyTheTransitionsOfTheFigure) {
  const auto paths = reachable();
  EXPECT_EQ(paths.size(), std::size(kStates));
  std::set<std::string> arrows;
  for (const auto& [state, path] : paths)
    for (const FlightInput input : kInputs) {
      FlightStateMachine machine = after(path);
      const auto result = machine.apply(input);
      if (result) {
        arrows.insert(std::string(common::toString(state)) + " -" + toString(input) + "-> " +
                      common::toString(*result));
      } else {
        EXPECT_EQ(machine.state(), state) << "a refused input changes nothing";
        EXPECT_THAT(result.error(), testing::HasSubstr(common::toString(state)));
      }
    }
  EXPECT_EQ(arrows.size(), 14u) << testing::PrintToString(arrows);
}

TEST(FlightStateMachine, ActivationsAreThoseOfTable1) {
  const auto active = [](FlightState state) {
    const Activation a = activationOf(state);
    return std::tuple(a.fusion, a.control, a.waypoints);
  };
  EXPECT_EQ(active(FlightState::kPreparation), std::tuple(false, false, false));
  EXPECT_EQ(active(FlightState::kPoweredOff), std::tuple(true, false, false));
  EXPECT_EQ(active(FlightState::kLanded), std::tuple(true, false, false));
  EXPECT_EQ(active(FlightState::kTakingOff), std::tuple(true, true, false));
  EXPECT_EQ(active(FlightState::kFlying), std::tuple(true, true, true));
  EXPECT_EQ(active(FlightState::kLanding), std::tuple(true, true, false));
  EXPECT_EQ(active(FlightState::kEmergencyLanding), std::tuple(false, true, false));
}

TEST(FlightStateMachine, AnEmergencyStartsInAnyStateInTheAirAndEndsOnlyAtTouchdown) {
  for (const auto& [state, path] : reachable()) {
    FlightStateMachine machine = after(path);
    const auto result = machine.apply(FlightInput::kEmergency);
    if (state == FlightState::kEmergencyLanding) {
      EXPECT_FALSE(result);
    } else if (isAirborne(state)) {
      EXPECT_EQ(result.value(), FlightState::kEmergencyLanding);
    } else if (state == FlightState::kLanded) {
      EXPECT_EQ(result.value(), FlightState::kPoweredOff);
    } else {
      EXPECT_FALSE(result);
    }
  }
  FlightStateMachine machine = after(reachable().at(FlightState::kEmergencyLanding));
  for (const FlightInput input : kInputs) {
    if (input == FlightInput::kTouchedDown) continue;
    EXPECT_FALSE(machine.apply(input)) << toString(input);
  }
  EXPECT_EQ(machine.apply(FlightInput::kTouchedDown).value(), FlightState::kPoweredOff);
}

}  // namespace
}  // namespace swiftlet::control
