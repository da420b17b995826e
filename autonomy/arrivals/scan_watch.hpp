// Judges the scans as they arrive: a laser that repeats its last scan, scans that are late, a clock that is wrong.
#pragma once

#include <memory>
#include <vector>

#include "autonomy/arrivals/laser_clock.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::autonomy {

/// One thread. The noise of the ranges makes each scan differ from the one before, so a scan whose ranges are equal bit
/// by bit comes from a driver that repeats its last one and is left out. A scan without a single return carries no
/// noise; it never counts as repeated.
class ScanWatch {
 public:
  using Scan = std::shared_ptr<const common::LaserScan>;

  /// `period_s`: time from one scan of the laser to the next.
  ScanWatch(double period_s, common::EventLog& log) : clock_(period_s), log_(log) {}

  /// The scan with the stamp that the laser's clock as it was at first would have given it; null for one that repeats
  /// the last, that is too old, or of which nobody knows when it was measured.
  Scan take(Scan scan);

 private:
  /// A single scan given twice is a hiccup of a link and needs no event; the next one is measured later than this.
  static constexpr double kHiccup_s = 1e-3;

  void sayTiming(common::Time now);
  bool repeats(const common::LaserScan& scan);

  LaserClock clock_;
  ScanTiming said_ = ScanTiming::kUsual;
  std::vector<float> last_ranges_m_;
  common::Hysteresis repeats_{kHiccup_s};
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
