#include "evaluation/gain_cost.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::evaluation {
namespace {

double costOf(const FlightScore& flight) {
  double sum = 0.0;
  int count = 0;
  for (const PhaseScore& phase : flight.phases)
    for (const PhaseBound& bound : phase.criteria) {
      if (!(std::isfinite(bound.max) && bound.max > 0.0)) continue;
      const std::optional<double> value = phase.figure(bound.figure);
      const bool measured = value && std::isfinite(*value);
      sum += measured ? std::min(std::abs(*value) / bound.max, kGreatestGainCost) : kGreatestGainCost;
      ++count;
    }
  return flight.collisions > 0 || count == 0 ? kGreatestGainCost : sum / count;
}

}  // namespace

double gainCost(const std::vector<FlightScore>& flights) {
  double sum = 0.0;
  for (const FlightScore& flight : flights) sum += costOf(flight);
  return flights.empty() ? kGreatestGainCost : sum / static_cast<double>(flights.size());
}

}  // namespace swiftlet::evaluation
