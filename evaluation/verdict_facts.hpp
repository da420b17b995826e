// The facts about the end of a flight, from its record and the true world.
#pragma once

#include "evaluation/flight_recorder.hpp"
#include "evaluation/true_world.hpp"
#include "evaluation/verdict.hpp"

namespace swiftlet::evaluation {

/// Computes the true free space only for a flight that ended on the ground before its mission was done. Without
/// rays in the world the places are unknown.
VerdictFacts factsOf(const FlightRecord& record, const TrueWorld& world);

}  // namespace swiftlet::evaluation
