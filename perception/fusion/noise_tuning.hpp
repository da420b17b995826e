// Learns the noise parameters of the filter from flights whose true velocity is known (Bachrach 2009, section 5.2,
// after Abbeel et al. 2005: discriminative training, by stochastic gradient descent).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "perception/fusion/fusion_config.hpp"
#include "perception/fusion/taped_flight.hpp"

namespace swiftlet::perception {

/// RMS of the velocity error in the level body frame, which needs no common frame, over all flights; infinity if the
/// filter diverges in one of them or does not start.
double velocityError_m_s(const std::vector<const TapedFlight*>& flights, const FusionConfig& config);

struct TuningOptions {
  int steps = 40;
  int flights_a_step = 2;     ///< A step sees a random subset of the flights.
  double perturbation = 0.3;  ///< Of the logarithm of each parameter.
  double rate = 0.5;          ///< Greatest change of a logarithm in the first step; it falls with the steps.
  std::uint64_t seed = 1;
};

struct Tuning {
  FusionConfig config;
  double before_m_s = 0.0, after_m_s = 0.0;  ///< On all flights that were learned from.
};

/// Simultaneous perturbation on the logarithms of the noise parameters, each within a factor of 30 of its start. The
/// best of the parameters that were reached, by all flights, is returned: never worse than the start. Deterministic.
/// `progress`, if there is one, is called after each step.
Tuning tuneNoise(const std::vector<const TapedFlight*>& flights, const FusionConfig& start,
                 const TuningOptions& options,
                 const std::function<void(int step, double best_m_s)>& progress = nullptr);

/// The tuned parameters by name, with their place in a config.
struct NoiseParameter {
  const char* name;
  double FusionConfig::*value;
};
const std::vector<NoiseParameter>& noiseParameters();

}  // namespace swiftlet::perception
