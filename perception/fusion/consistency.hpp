// Whether the filter's errors agree with its covariance in recorded flights whose truth is known: the normalized error
// squared (NEES) of velocity, place, heading and height, and the normalized innovation squared (NIS) of the
// measurements (Bar-Shalom, Li and Kirubarajan 2001, section 5.4). For each degree of freedom both have the mean 1.
#pragma once

#include <string>
#include <vector>

#include "perception/fusion/taped_flight.hpp"

namespace swiftlet::perception {

/// A quantity over many flights. The flights are independent of each other, the instants of one flight are not: so the
/// bounds are those of the mean over the flights at one instant.
struct ConsistencyFigure {
  std::string name;
  int degrees = 0;     ///< Degrees of freedom of one sample; of innovations, the mean number in an interval.
  double mean = 0.0;   ///< For each degree of freedom, over all instants and flights.
  double lower = 0.0;  ///< Bounds of 95 % for the mean over the flights at one instant.
  double upper = 0.0;
  double inside_share = 0.0;  ///< Share of the instants at which that mean is within the bounds.
  /// Mean standard deviation by the filter over the best constant one, which is that of its actual errors. 0 for
  /// innovations.
  double sigma_ratio = 0.0;

  /// The mean is within the bounds.
  bool consistent() const { return mean >= lower && mean <= upper; }
  /// The variance is within twice the best constant one, either way, as far as it has one.
  bool well_sized() const {
    return sigma_ratio == 0.0 || (sigma_ratio * sigma_ratio >= 0.5 && sigma_ratio * sigma_ratio <= 2.0);
  }
};

struct Consistency {
  std::size_t flights = 0;
  std::size_t instants = 0;
  std::size_t diverged = 0;  ///< Flights that were left out.
  /// NEES: horizontal velocity in the level body frame, climb, place and heading in odom, height.
  std::vector<ConsistencyFigure> errors;
  std::vector<ConsistencyFigure> innovations;  ///< NIS of relative poses and heights, over a second each.
};

/// Replays the filters' inputs, and compares once a second, from the first truth on. The truth's frame must be
/// the frame of the filter's start, as that of a take-off is.
Consistency consistencyOf(const std::vector<TapedFlight>& flights, const FusionConfig& config);

/// Bounds of 95 %, two-sided, of a chi-squared variable over its degrees of freedom (Wilson and Hilferty 1931).
struct ChiSquaredBounds {
  double lower = 0.0, upper = 0.0;
};
ChiSquaredBounds chiSquaredBounds95(double degrees);

}  // namespace swiftlet::perception
