// What the vehicle does about what is found to be wrong: one ranked table, of which at most one row is active.
//
//   measurements --> checks --> findings --> this table --> response
//
// [Tomic 2012, "Action": the state machine lands, or descends, when the fusion fails; the rows above the estimate are
// those of a flight by a mission]
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "common/world/flight_state.hpp"

namespace swiftlet::control {

/// What can be wrong.
enum class FindingKind {
  kEstimateDiverged,    ///< The fusion's innovations or covariances are impossible.
  kHeightLost,          ///< No valid height.
  kInertialUnusable,    ///< Inertial samples are missing, not finite, old or repeated.
  kSensorContradicted,  ///< Inertial samples contradict the AHRS or the thrust.
  kHorizontalLost,      ///< No valid horizontal position.
  kSurroundingsLost,    ///< No sensor has seen the surroundings for long.
  kPositionLost,        ///< The position has become too uncertain to fly back.
  kChargeSpent,         ///< The charge at which the vehicle lands.
  kThrustSpent,         ///< The thrust hardly carries the weight.
  kSurroundingsUnseen,  ///< No sensor sees the surroundings.
  kPilotSilent,         ///< A pilot who flies is not heard of.
  kHeightUnmeasured,    ///< The surface below is not measured.
  kPositionUncertain,
  kChargeForHome,      ///< The charge suffices for the flight home and hardly for more.
  kHomeOutOfReach,     ///< During the flight home: the charge suffices for it no longer.
  kBatteryUnmeasured,  ///< The battery has sent no sample yet.
  kChargeBelow30,
  kChargeBelow20,
  kChargeCountedOn,  ///< The gauge gives nothing usable: the charge is the last one less the current drawn.
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
/// An emergency landing is a landing here: it has the highest rank in the air already.
FlightPhase phaseOf(common::FlightState state);

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

/// By rank, the highest first.
std::span<const Failsafe> failsafes();
/// The row of that finding in that phase; null if nothing follows from it then.
const Failsafe* failsafeFor(FindingKind finding, FlightPhase phase);
/// The row that is active when all these are found in that phase; null if none is.
const Failsafe* activeFailsafe(std::span<const FindingKind> findings, FlightPhase phase);

/// "surroundings unseen"; also the names that `swiftlet failsafe` takes, with hyphens.
std::string_view toString(FindingKind finding);
/// When that is found, as a sentence.
std::string_view meaning(FindingKind finding);
/// "fly back along the trail".
std::string_view toString(Response response);
/// "taking off".
std::string_view toString(FlightPhase phase);
/// "with the finding".
std::string_view toString(Ends ends);
/// What the operator can do meanwhile.
std::string_view operatorCan(const Failsafe& row);

}  // namespace swiftlet::control
