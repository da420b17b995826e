#include "perception/laser_odometry/scan_clock.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swiftlet::perception {
namespace {

using common::Duration;

/// So many doubtful stamps make the others doubtful too.
constexpr std::uint64_t kDistrusts = 3;
/// No laser turns faster: of scans stamped nearer to each other, one was held up on its way.
constexpr Duration kLeastInterval = Duration::fromMilliseconds(5);
/// Between scans whose stamps are all the same: so long that no step of a robot is too far for it.
constexpr Duration kUnknownInterval = Duration::fromMilliseconds(1000);
/// In a longer pause, or with stamps out of all bounds, a robot may have gone anywhere as well.
constexpr double kLongestInterval_s = 3600.0;

/// The difference of any two stamps, also of some that are too far apart to be subtracted.
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

/// A laser keeps its rate: after a longer interval, one of less than half the usual was no scan's.
bool ScanClock::isEarly(Duration interval) const {
  return interval * 2 < last_interval_ && interval * 2 < usualInterval();
}

/// The mean of the middle ones: late stamps and early ones make up for each other, a wrong one does not count.
Duration ScanClock::usualInterval() const {
  std::array<Duration, kRemembered> sorted = intervals_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(ticks_, kRemembered));
  std::sort(sorted.begin(), end);
  const std::ptrdiff_t cut = (end - sorted.begin()) / 20, kept = end - sorted.begin() - 2 * cut;
  const Duration mean = std::accumulate(sorted.begin() + cut, end - cut, Duration()) / kept;
  return mean > Duration() ? mean : kUnknownInterval;
}

}  // namespace swiftlet::perception
