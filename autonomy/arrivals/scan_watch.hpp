// Notices a laser that repeats its last scan with new stamps.
#pragma once

#include <vector>

#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::autonomy {

/// One thread. The noise of the ranges makes each scan differ from the one before, so a scan whose ranges are equal bit
/// by bit comes from a driver that repeats its last one and is left out. A scan without a single return carries no
/// noise; it never counts as repeated.
class ScanWatch {
 public:
  explicit ScanWatch(common::EventLog& log) : log_(log) {}

  /// Whether this scan repeats the one before it.
  bool repeats(const common::LaserScan& scan);

 private:
  /// A single scan given twice is a hiccup of a link and needs no event; the next one is measured later than this.
  static constexpr double kHiccup_s = 1e-3;

  std::vector<float> last_ranges_m_;
  common::Hysteresis repeats_{kHiccup_s};
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
