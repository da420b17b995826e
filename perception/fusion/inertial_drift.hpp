// The velocity by integrated acceleration alone beside that of the filter and the truth (Bachrach 2009, Fig. 3a).
#pragma once

#include <vector>

#include "perception/fusion/taped_flight.hpp"

namespace swiftlet::perception {

/// Forward velocities in the level body frame at one instant.
struct ForwardVelocity {
  double time_s = 0.0;  ///< Since the first instant.
  double true_m_s = 0.0;
  double filtered_m_s = 0.0;
  double integrated_m_s = 0.0;
};

/// One entry for each instant of the flight's truth, from the first at which the filter has started. There the
/// integrated velocity is the true one; from then on it is the specific force of each sample, turned by its AHRS, less
/// gravity, and nothing corrects it.
std::vector<ForwardVelocity> inertialDrift(const TapedFlight& flight, const FusionConfig& config);

}  // namespace swiftlet::perception
