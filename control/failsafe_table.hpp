// The table of fail-safes: what can be wrong, in words, and what follows in which part of a flight. A finding is added
// here, and the check that finds it in autonomy/health/checks.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace swiftlet::control {

/// What can be wrong; kFindingTexts has the words.
enum class FindingKind {
  kEstimateDiverged,
  kHeightLost,
  kInertialUnusable,
  kSensorContradicted,
  kHorizontalLost,
  kSurroundingsLost,
  kPositionLost,
  kChargeSpent,
  kThrustSpent,
  kPeopleAllRound,
  kSurroundingsUnseen,
  kPilotSilent,
  kHeightUnmeasured,
  kPositionUncertain,
  kChargeForHome,
  kHomeOutOfReach,
  kBatteryUnmeasured,
  kChargeBelow30,
  kChargeBelow20,
  kGaugeUnusable,
};

/// What the vehicle does about it, the higher ranks last.
enum class Response {
  kNone,
  kWarn,
  kRefuseTakeOff,
  kFlyHome,  ///< It lands there.
  kFlyBack,  ///< Along its trail until height and position are known again.
  kHold,
  kLand,       ///< Where it is, for good.
  kDescend,    ///< Emergency landing: without a valid estimate, by the raw height and the thrust.
  kMotorsOff,  ///< At once, standing.
};
inline constexpr int kResponses = 9;

/// The part of a flight in which a row of the table applies.
enum class FlightPhase { kOnGround, kTakingOff, kFlying, kLanding };
inline constexpr std::array kFlightPhases{FlightPhase::kOnGround, FlightPhase::kTakingOff, FlightPhase::kFlying,
                                          FlightPhase::kLanding};

/// When a response ends.
enum class Ends {
  kWithFinding,
  kOnResume,  ///< By the operator.
  kNever,     ///< In this flight.
};

/// A row of the table: one finding in some phases.
struct Failsafe {
  FindingKind finding;
  std::array<bool, kFlightPhases.size()> phases;  ///< In the order of kFlightPhases.
  Response response;
  Ends ends;
  /// What follows when the response has been carried out and the finding remains; kNone if nothing does.
  Response then = Response::kNone;
};

/// A finding in words: its name, and when it is found.
struct FindingText {
  FindingKind finding;
  std::string_view name, meaning;
};

namespace failsafe_table {

using enum FindingKind;

inline constexpr FindingText kFindingTexts[] = {
    {kEstimateDiverged, "estimate diverged", "Innovations or covariances of the fusion are impossible."},
    {kHeightLost, "height lost", "There is no valid height for 0.3 s."},
    {kInertialUnusable, "inertial unusable", "Inertial samples are missing, not finite, old or repeated for 0.2 s."},
    {kSensorContradicted, "sensor contradicted",
     "Inertial samples have contradicted the AHRS or the thrust for 1.5 s and are replaced."},
    {kHorizontalLost, "horizontal lost",
     "There is no valid horizontal position for 1 s, or for 3 s while inertial samples carry the velocity."},
    {kSurroundingsLost, "surroundings lost",
     "No sensor has seen the surroundings for 3.3 s, or for 10 s while other sensors measure the position."},
    {kPositionLost, "position lost", "The position is uncertain by more than 2 m, in the open 4 m."},
    {kChargeSpent, "charge spent",
     "The charge is below `battery_land_share`, before a take-off below that and `home_reserve_share`."},
    {kThrustSpent, "thrust spent",
     "The greatest thrust has been below `least_thrust_margin` times the weight for 1 s."},
    {kPeopleAllRound, "people all round",
     "No course has been free of people for 0.3 s, and the ground below is level."},
    {kSurroundingsUnseen, "surroundings unseen", "No sensor has seen the surroundings for 0.3 s."},
    {kPilotSilent, "pilot silent", "There is no sample from a pilot who flies for 1 s."},
    {kHeightUnmeasured, "height unmeasured", "The surface below has not been measured for 0.5 s."},
    {kPositionUncertain, "position uncertain", "The position is uncertain by more than 1 m."},
    {kChargeForHome, "charge for home",
     "The charge suffices for 1.15 times the flight home and `home_reserve_share`, and no longer."},
    {kHomeOutOfReach, "home out of reach", "The charge is less than 0.8 times what the flight home takes."},
    {kBatteryUnmeasured, "battery unmeasured", "The battery has sent no sample yet."},
    {kChargeBelow30, "charge below 30", "The charge is 30 % or less."},
    {kChargeBelow20, "charge below 20", "The charge is 20 % or less."},
    {kGaugeUnusable, "gauge unusable",
     "The gauge of the battery is silent or stuck: the charge is estimated by the current drawn."},
};

using Phases = std::array<bool, kFlightPhases.size()>;
inline constexpr Phases kGround{true, false, false, false}, kAir{false, true, true, true},
    kUpAndFlying{false, true, true, false}, kInFlight{false, false, true, false}, kAlways{true, true, true, true};

/// Rows of equal responses are ranked by their order.
inline constexpr Failsafe kFailsafes[] = {
    {kEstimateDiverged, kGround, Response::kMotorsOff, Ends::kNever},
    {kEstimateDiverged, kAir, Response::kDescend, Ends::kNever},
    {kHeightLost, kAir, Response::kDescend, Ends::kNever},
    {kInertialUnusable, kAir, Response::kDescend, Ends::kNever},
    {kSensorContradicted, kAir, Response::kLand, Ends::kNever},
    {kHorizontalLost, kUpAndFlying, Response::kLand, Ends::kNever},
    {kSurroundingsLost, kAir, Response::kLand, Ends::kNever},
    {kPositionLost, kInFlight, Response::kLand, Ends::kNever},
    {kChargeSpent, kAir, Response::kLand, Ends::kNever},
    {kThrustSpent, kInFlight, Response::kLand, Ends::kNever},
    {kPeopleAllRound, kInFlight, Response::kLand, Ends::kNever},
    {kSurroundingsUnseen, kAir, Response::kHold, Ends::kWithFinding},
    {kPilotSilent, kAlways, Response::kHold, Ends::kOnResume},
    {kHeightUnmeasured, kInFlight, Response::kFlyBack, Ends::kWithFinding, Response::kLand},
    {kPositionUncertain, kInFlight, Response::kFlyBack, Ends::kWithFinding, Response::kLand},
    {kChargeForHome, kInFlight, Response::kFlyHome, Ends::kNever, Response::kLand},
    {kBatteryUnmeasured, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kThrustSpent, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kChargeSpent, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kInertialUnusable, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kHeightLost, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kHorizontalLost, kGround, Response::kRefuseTakeOff, Ends::kWithFinding},
    {kGaugeUnusable, kAir, Response::kWarn, Ends::kWithFinding},
    {kChargeBelow30, kAir, Response::kWarn, Ends::kNever},
    {kChargeBelow20, kAir, Response::kWarn, Ends::kNever},
    {kHomeOutOfReach, kInFlight, Response::kWarn, Ends::kNever},
};

static_assert(std::is_sorted(std::begin(kFailsafes), std::end(kFailsafes),
                             [](const Failsafe& a, const Failsafe& b) { return a.response > b.response; }),
              "the rows stand by rank");
static_assert(std::all_of(std::begin(kFailsafes), std::end(kFailsafes),
                          [](const Failsafe& row) {
                            return std::any_of(std::begin(kFindingTexts), std::end(kFindingTexts),
                                               [&](const FindingText& text) { return text.finding == row.finding; });
                          }),
              "a finding of the table has its words");

}  // namespace failsafe_table
}  // namespace swiftlet::control
