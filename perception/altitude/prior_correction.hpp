// The correction of a prior by a level that was just entered, until the fusion filter, which provides the prior, has
// received the measurement itself.
#pragma once

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/altitude/height_filter.hpp"
#include "perception/altitude/height_measurement.hpp"
#include "perception/altitude/level_matching.hpp"

namespace swiftlet::perception::altitude {

struct PriorCorrection {
  int level = kNoLevel;
  common::Time since;
  double height_m = 0.0;  ///< To be added to the prior's height.
  double velocity_m_s = 0.0;
  Eigen::Matrix2d covariance;  ///< Of height and velocity after the correction.
  bool confirmed = false;      ///< The level was seen for so long before that leaving it does not call it in question.
  bool jumps = false;          ///< The prior is not used until it agrees: the fusion filter resists at first.

  /// Whether a prior has jumped, too, so that it agrees with the present height.
  bool isTakenIn(const HeightState& prior, const HeightFilter& present) const;
  /// The prior with the correction; after a jump the present height instead, moved to `now`.
  HeightState applied(const HeightState& prior, const HeightFilter& present, common::Time now) const;
};

}  // namespace swiftlet::perception::altitude
