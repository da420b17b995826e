// Whether the filter's errors agree with its covariance in recorded flights whose truth is known: the normalized error
// squared (NEES) of velocity and height, and the normalized innovation squared (NIS) of the measurements (Bar-Shalom,
// Li and Kirubarajan 2001, section 5.4). For each degree of freedom both have the mean 1.
#pragma once

#include <string>
#include <vector>

#include "perception/fusion/taped_flight.hpp"

namespace swiftlet::perception {

/// A quantity over many flights. The flights are independent of each other, the instants of one flight are not: so the
/// bounds are those of the mean over the flights at one instant.
struct ConsistencyFigure {
  std::string name;
  int degrees = 0;     ///< Degrees of freedom of one sample.
  double mean = 0.0;   ///< For each degree of freedom, over all instants and flights.
  double lower = 0.0;  ///< Bounds of 95 % for the mean over the flights at one instant.
  double upper = 0.0;
  double inside_share = 0.0;  ///< Share of the instants at which that mean is within the bounds.
};

struct Consistency {
  std::size_t flights = 0;
  std::size_t instants = 0;
  std::size_t diverged = 0;               ///< Flights that were left out.
  std::vector<ConsistencyFigure> errors;  ///< NEES: horizontal velocity in the level body frame, climb, height.
  double relative_pose_nis = 0.0, height_nis = 0.0;
};

/// Replays what the filters were told, and compares once a second, from the first truth on.
Consistency consistencyOf(const std::vector<TapedFlight>& flights, const FusionConfig& config);

/// Bounds of 95 %, two-sided, of a chi-squared variable over its degrees of freedom (Wilson and Hilferty 1931).
struct ChiSquaredBounds {
  double lower = 0.0, upper = 0.0;
};
ChiSquaredBounds chiSquaredBounds95(double degrees);

}  // namespace swiftlet::perception
