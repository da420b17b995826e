#include "perception/laser_odometry/scan_clock.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swiftlet::perception {
namespace {

using common::Duration;

/// After this many unreliable stamps, no stamp is used any more.
constexpr std::uint64_t kDistrusts = 3;
/// No laser turns faster. If stamps are closer to each other, one of the scans was delayed in transit.
constexpr Duration kLeastInterval = Duration::fromMilliseconds(5);
/// The interval for stamps that are all equal. It is long enough for any step of a robot to be plausible.
constexpr Duration kUnknownInterval = Duration::fromMilliseconds(1000);
/// Longer intervals, also those of absurd stamps, are cut to this. In such a pause a robot may go anywhere in any case.
constexpr double kLongestInterval_s = 3600.0;

/// The difference of two stamps, cut to the longest interval. The stamps may be too far apart to be subtracted.
Duration boundedInterval(common::Time from, common::Time to) {
  const double seconds = to.seconds() - from.seconds();
  if (std::abs(seconds) < kLongestInterval_s) return to - from;
  return Duration::fromSeconds(std::copysign(kLongestInterval_s, seconds));
}

}  // namespace

common::Time ScanClock::tick(common::Time stamp) {
  if (ticks_ == 0) {
    now_ = stamp;
  } else {
    const Duration interval = boundedInterval(last_stamp_, stamp);
    intervals_[(ticks_ - 1) % kRemembered] = interval;
    const bool credible = interval >= kLeastInterval && !isEarly(interval);
    if (!credible) ++unreliable_;
    now_ += std::max(credible && unreliable_ < kDistrusts ? interval : usualInterval(), kLeastInterval);
    last_interval_ = interval;
  }
  last_stamp_ = stamp;
  ++ticks_;
  return now_;
}

/// Whether an interval is less than half of the usual one and of the one before. A laser keeps its rate, so the stamp
/// of the scan before was late.
bool ScanClock::isEarly(Duration interval) const {
  return interval * 2 < last_interval_ && interval * 2 < usualInterval();
}

/// The trimmed mean of the last intervals. Late and early stamps cancel in the mean, and outliers are cut off.
Duration ScanClock::usualInterval() const {
  std::array<Duration, kRemembered> sorted = intervals_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(ticks_, kRemembered));
  std::sort(sorted.begin(), end);
  const std::ptrdiff_t cut = (end - sorted.begin()) / 20, kept = end - sorted.begin() - 2 * cut;
  const Duration mean = std::accumulate(sorted.begin() + cut, end - cut, Duration()) / kept;
  return mean > Duration() ? mean : kUnknownInterval;
}

}  // namespace swiftlet::perception
