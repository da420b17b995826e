#include "control/identification/flight_samples.hpp"

#include "common/median_step.hpp"

namespace swiftlet::control {

double periodOf_s(const FlightSamples& flight) {
  return common::medianStep_s(flight, [](const FlightSample& sample) { return sample.stamp; });
}

}  // namespace swiftlet::control
