// What the vehicle does about what is found to be wrong: one ranked table, of which at most one row is active.
//
//   measurements --> checks --> findings --> this table --> response
//
// [Tomic 2012, "Action": the state machine lands, or descends, when the fusion fails; the rows above the estimate are
// those of a flight by a mission]
#pragma once

#include <span>
#include <string_view>

#include "common/world/flight_state.hpp"
#include "control/failsafe_table.hpp"

namespace swiftlet::control {

/// An emergency landing is a landing here: it has the highest rank in the air already.
FlightPhase phaseOf(common::FlightState state);

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
