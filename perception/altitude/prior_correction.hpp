// The correction of a prior, until the fusion filter, which provides the prior, has received the measurement itself.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/altitude/height_filter.hpp"
#include "perception/altitude/height_measurement.hpp"
#include "perception/altitude/level_matching.hpp"

namespace swiftlet::perception::altitude {

/// A level was entered: the prior is corrected by what that changed.
struct EnteredLevel {
  int level = kNoLevel;
  common::Time since;
  double height_m = 0.0;  ///< To be added to the prior's height.
  double velocity_m_s = 0.0;
  Eigen::Matrix2d covariance;  ///< Of height and velocity after the correction.
  bool confirmed = false;      ///< The level was seen for so long before that leaving it does not make it doubtful.
};

/// The assumed level turned out to be the floor. The prior is not used until it agrees: the fusion filter resists at
/// first, and a part of the correction would pass by the right height.
struct RegainedFloor {
  common::Time since;
  Eigen::Matrix2d covariance;  ///< Of height and velocity after the correction.
};

/// At most one correction is under way.
class PriorCorrection {
 public:
  void begin(const EnteredLevel& entered) { entered_ = entered; }
  void begin(const RegainedFloor& regained) {
    entered_.reset();
    regained_ = regained;
  }
  void end() {
    entered_.reset();
    regained_.reset();
  }

  bool underWay() const { return entered_ || regained_; }
  const std::optional<EnteredLevel>& entered() const { return entered_; }
  const std::optional<RegainedFloor>& regained() const { return regained_; }
  /// Leaving what is below does not call the correction in question.
  bool isConfirmed() const { return regained_ || (entered_ && entered_->confirmed); }
  /// Variance of the vertical speed after the correction; nullopt while no correction is under way.
  std::optional<double> speedVariance_m2_s2() const;

  /// The height and speed to start a scan from. Ends the correction by a regained floor once the prior agrees with the
  /// height of the last scan, `present`.
  HeightState applied(const HeightState& prior, const HeightFilter& present);

 private:
  std::optional<EnteredLevel> entered_;
  std::optional<RegainedFloor> regained_;
};

}  // namespace swiftlet::perception::altitude
