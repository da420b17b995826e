// A time that grows with every scan, of stamps that may not: those of old logs were taken when a message had come
// through the network, or not kept at all. Where stamps go back, or come in bursts that no laser sends, they are no
// measure of an interval, and the mean one is taken for each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/time.hpp"

namespace swiftlet::perception {

class ScanClock {
 public:
  /// The time of a scan with that stamp; after all before.
  common::Time tick(common::Time stamp);
  /// Stamps that did not come after the one before, or sooner than a laser turns.
  std::uint64_t unreliable() const { return unreliable_; }

 private:
  bool isEarly(common::Duration interval) const;
  common::Duration usualInterval() const;

  static constexpr std::size_t kRemembered = 128;
  std::array<common::Duration, kRemembered> intervals_;  ///< The last ones, as stamped, in no order.
  std::uint64_t ticks_ = 0, unreliable_ = 0;
  common::Duration last_interval_;
  common::Time last_stamp_, now_;
};

}  // namespace swiftlet::perception
