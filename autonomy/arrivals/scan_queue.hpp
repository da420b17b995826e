// Puts scans that overtook each other on their link back in the order in which they were measured, as far as a short
// wait allows.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

struct ScanQueueConfig {
  double latency_s = 0.004;
  double reorder_wait_s = 0.03;  ///< Greatest wait of a scan for one that was measured before it and has not arrived.

  void describe(common::config::Fields& fields);
};

/// One thread.
class ScanQueue {
 public:
  /// `period_s`: time from one scan of the laser to the next.
  ScanQueue(const ScanQueueConfig& config, double period_s) : config_(config), period_s_(period_s) {}

  /// A scan that was measured before the last one taken is counted and left out; then it returns false.
  bool add(std::shared_ptr<const common::LaserScan> scan);
  /// The oldest scan that is due at `now`; null without one. A scan that follows the last one without a gap is due
  /// `latency_s` after its arrival. After a gap it waits for the missing scan, for at most `reorder_wait_s` more.
  std::shared_ptr<const common::LaserScan> take(common::Time now);

  /// When the last scan that was taken was measured.
  common::Time lastMeasured() const { return last_measured_; }
  std::uint64_t lateScans() const { return late_scans_; }

 private:
  bool followsAtOnce(common::Time measured) const;

  ScanQueueConfig config_;
  double period_s_;
  std::vector<std::shared_ptr<const common::LaserScan>> waiting_;  ///< By time of measurement, the oldest first.
  common::Time last_measured_;
  bool any_taken_ = false;
  std::uint64_t late_scans_ = 0;
};

}  // namespace swiftlet::autonomy
