#include "autonomy/arrivals/scan_queue.hpp"

#include <algorithm>
#include <utility>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::Duration;
using common::Time;

void ScanQueueConfig::describe(common::config::Fields& fields) {
  fields("latency_s", latency_s, {0, 0.2}, "Declared time for projecting and matching one scan.");
}

bool ScanQueue::add(std::shared_ptr<const common::LaserScan> scan) {
  const Time measured = scan->stamps.measured;
  if (any_taken_ && measured <= last_measured_) {
    ++late_scans_;
    return false;
  }
  const auto later = std::find_if(waiting_.begin(), waiting_.end(),
                                  [measured](const auto& other) { return measured < other->stamps.measured; });
  waiting_.insert(later, std::move(scan));
  return true;
}

bool ScanQueue::followsAtOnce(Time measured) const {
  constexpr double kGap = 1.5;  // In periods.
  return !any_taken_ || (measured - last_measured_).seconds() < kGap * period_s_;
}

std::shared_ptr<const common::LaserScan> ScanQueue::take(Time now) {
  if (waiting_.empty()) return nullptr;
  const common::Stamps& stamps = waiting_.front()->stamps;
  const double wait_s = config_.latency_s + (followsAtOnce(stamps.measured) ? 0.0 : config_.reorder_wait_s);
  if (now < stamps.arrived + Duration::fromSeconds(wait_s)) return nullptr;
  last_measured_ = stamps.measured;
  auto scan = std::move(waiting_.front());
  waiting_.erase(waiting_.begin());
  any_taken_ = true;
  return scan;
}

}  // namespace swiftlet::autonomy
