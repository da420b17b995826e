// Each scan serves the odometry or weighs particles, never both: whose turn the next one is.
#pragma once

#include "common/geometry.hpp"
#include "perception/localization/localizer.hpp"

namespace swiftlet::perception {

class ScanTurns {
 public:
  /// Whether the next scan, expected at that pose, is to be kept from the odometry. Never two in a row: the odometry
  /// needs scans that overlap. To be asked once for each scan.
  bool withholdNext(const Localizer& localizer, const common::Pose2& T_odom_body) {
    withheld_last_ = !withheld_last_ && localizer.wantsFreshScan(T_odom_body);
    return withheld_last_;
  }

 private:
  bool withheld_last_ = true;  ///< The first scan is the odometry's.
};

}  // namespace swiftlet::perception
