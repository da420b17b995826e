// Real time: how much has passed, and the pace of a flight.
#pragma once

#include <atomic>
#include <chrono>

#include "common/time.hpp"

namespace swiftlet::flight {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The time of a flight, which passes at a multiple of real time from the moment at which this object is made. Any
/// thread.
class Pace {
 public:
  /// `speed` 0: as fast as the computer can; then nothing is waited for.
  explicit Pace(double speed, common::Time begin = {}) : speed_(speed), begin_(begin) {}

  /// The time at which the flight should be now.
  common::Time now() const { return begin_ + common::Duration::fromSeconds(wall_s() * speed_); }
  void waitUntil(common::Time time) const;
  /// Real time that has passed.
  double wall_s() const { return secondsSince(wall_begin_); }

 private:
  double speed_;
  common::Time begin_;
  Clock::time_point wall_begin_ = Clock::now();
};

/// Waits at the end of a flight, so that its pages show how it ended; only briefly once `stop` (may be null) is set.
void lingerForPages(const std::atomic<bool>* stop);

}  // namespace swiftlet::flight
