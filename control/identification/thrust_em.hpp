// C(U), the command that carries the weight by battery voltage, from several flights by expectation-maximization
// (Grzonka 2012, section IV-D).
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "common/vehicle_config.hpp"
#include "control/identification/flight_samples.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::control {

struct ThrustEmOptions {
  int knots = 9;             ///< Over the voltages that were flown.
  double shortest_s = 20.0;  ///< Less flight is not enough.
  double smooth_s = 0.5;     ///< The vertical acceleration is averaged over this time.
  double settled = 1e-5;     ///< The offset counts as settled when no knot moves by more.
  int most_rounds = 200;
};

struct ThrustEm {
  ThrustPoints points;
  int rounds = 0;
  double sigma = 0.0;    ///< Standard deviation of the command about C(U) while the vehicle keeps its height.
  double keeping = 0.0;  ///< Share of the samples that count as keeping the height.
};

/// A sample either keeps the height, and its command (by tilt and vertical acceleration brought to a hover) is C(U)
/// with Gaussian noise, or it does not, and the command may be any. E-step: the probability of the first; M-step: C(U)
/// as the weighted least squares of a piecewise linear table, which never rises with the voltage, the noise and the
/// share. Fails, with the reason, for flights that are too short.
tl::expected<ThrustEm, std::string> thrustByVoltage(const std::vector<FlightSamples>& flights,
                                                    const common::VehicleConfig& vehicle,
                                                    const ThrustEmOptions& options = {});

}  // namespace swiftlet::control
