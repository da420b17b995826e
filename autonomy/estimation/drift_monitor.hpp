// How far the position has become uncertain since the take-off, where scans did not fix it.
//
// Along a corridor without features, and while no scan matches, the error grows. A scan that sees every direction again
// stops the growth, but it measures the position relative to what was seen before, not relative to the take-off: the
// error that was gathered remains. It is taken back only where the vehicle sees again what it mapped when it knew its
// position better: then it is as uncertain as it was there.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/hysteresis.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// The information of one scan on the position.
struct PositionFix {
  common::Time stamp;
  Eigen::Matrix2d covariance_odom_m2;  ///< The filter's, of the horizontal position, after the scan.
  bool matched = false;
  /// Unit vector along which the motion that a match does not show moves the position; nullopt if it fixes every
  /// direction.
  std::optional<Eigen::Vector2d> unobservable_direction_odom;
  /// Later scans are matched to this one, so its error is theirs.
  bool new_reference = false;
  /// The key scan of the map to which the pose is relative, and the one of an earlier pass, if the scan was matched to
  /// that pass alone in every direction; -1: none. Key scans count up from 0.
  int newest_key = -1, known_key = -1;
  /// What the match does not show is mostly a turn about some point. It moves the position by as much as the vehicle is
  /// away from that point, so that what was gathered on the way out goes on the way back.
  bool turns = false;
};

/// One thread. The ordinary error of matches that fix every direction, about a centimetre for each metre, is left out.
class DriftMonitor {
 public:
  /// Returns the standard deviation in the weakest direction, in metres.
  double add(const PositionFix& fix);

 private:
  /// One good scan may be a chance match, so error is taken back only when every scan has fixed the position for this
  /// long.
  static constexpr double kHeld_s = 0.5;
  Eigen::Matrix2d grownSince(const PositionFix& fix) const;
  void recall(int key);

  Eigen::Matrix2d drift_m2_ = Eigen::Matrix2d::Zero();            ///< Since the take-off, in odom.
  Eigen::Matrix2d reference_drift_m2_ = Eigen::Matrix2d::Zero();  ///< Of the scan to which scans are matched.
  Eigen::Matrix2d covariance_m2_ = Eigen::Matrix2d::Zero();       ///< The filter's, from which the growth counts.
  common::Hysteresis held_{kHeld_s};                              ///< Every scan fixes every direction.
  std::vector<Eigen::Matrix2d> key_drift_m2_;                     ///< Of each key scan.
};

}  // namespace swiftlet::autonomy
