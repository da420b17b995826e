// Decides whether the next scan is used by the odometry or weighs the particles. No scan is used for both.
#pragma once

#include "common/geometry.hpp"
#include "perception/localization/localizer.hpp"

namespace swiftlet::perception {

class ScanTurns {
 public:
  /// Whether the next scan, expected at that pose, is withheld from the odometry. Never two scans in a row, because the
  /// odometry needs scans that overlap. Call it once for each scan.
  bool withholdNext(const Localizer& localizer, const common::Pose2& T_odom_body) {
    withheld_last_ = !withheld_last_ && localizer.wantsFreshScan(T_odom_body);
    return withheld_last_;
  }

 private:
  bool withheld_last_ = true;  ///< The first scan goes to the odometry.
};

}  // namespace swiftlet::perception
