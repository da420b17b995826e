// The time of the present tick, and the step since the one before.
#pragma once

#include <algorithm>

#include "common/time.hpp"
#include "common/vehicle.hpp"

namespace swiftlet::control {

/// Steps are kControlPeriod at first. After a pause they are 5 periods at most, because nothing may be integrated over
/// it, and at least 1 ms, by which rates can be divided.
class TickClock {
 public:
  void advance(common::Time now) {
    constexpr double kPeriod_s = common::kControlPeriod.seconds();
    dt_s_ = ticked_ ? std::clamp((now - now_).seconds(), 1e-3, 5.0 * kPeriod_s) : kPeriod_s;
    ticked_ = true;
    now_ = now;
  }
  /// The zero time before the first tick.
  common::Time now() const { return now_; }
  double dt_s() const { return dt_s_; }

 private:
  common::Time now_;
  double dt_s_ = common::kControlPeriod.seconds();
  bool ticked_ = false;
};

}  // namespace swiftlet::control
