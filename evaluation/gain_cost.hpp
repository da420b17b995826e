// What a flight costs that is flown to compare gains: the figures of its phases over their bounds.
#pragma once

#include <vector>

#include "evaluation/flight_score.hpp"

namespace swiftlet::evaluation {

/// The cost of a figure that could not be measured, of a flight that touched something, and at most that of any figure.
inline constexpr double kGreatestGainCost = 10.0;

/// The mean over all flights of the mean over all criteria with a `max` of figure / max, each at most
/// kGreatestGainCost. A flight with a collision, or without such a criterion, costs kGreatestGainCost.
double gainCost(const std::vector<FlightScore>& flights);

}  // namespace swiftlet::evaluation
