// A clock that advances with every scan, even if the stamps do not. Scans in old logs were stamped when a message had
// come through the network, or have no stamps. Stamps that go back, or that come in faster bursts than a laser sends,
// do not measure an interval; the mean interval is used for each of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/time.hpp"

namespace swiftlet::perception {

/// Not thread-safe.
class ScanClock {
 public:
  /// The time of a scan with that stamp; later than all times before.
  common::Time tick(common::Time stamp);
  /// Number of stamps that were not after the one before, or followed it sooner than a laser turns.
  std::uint64_t unreliable() const { return unreliable_; }

 private:
  bool isEarly(common::Duration interval) const;
  common::Duration usualInterval() const;

  /// Three seconds at 40 Hz. The trimmed mean cuts six of them off at either end.
  static constexpr std::size_t kRemembered = 128;
  std::array<common::Duration, kRemembered> intervals_;  ///< The last intervals as stamped, in no order.
  std::uint64_t ticks_ = 0, unreliable_ = 0;
  common::Duration last_interval_;
  common::Time last_stamp_, now_;
};

}  // namespace swiftlet::perception
