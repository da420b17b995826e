// Which samples of the battery are used: a landing for a single wrong sample would not be taken back.
#pragma once

#include <optional>
#include <string>

#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::autonomy {

/// One thread. The current may be missing, see EnergyMonitor.
class BatteryCheck {
 public:
  explicit BatteryCheck(common::EventLog& log) : log_(log) {}

  /// Whether the sample is used. A charge that jumps is used once the next sample confirms it. The first sample that is
  /// not used leaves an event, and so does the first good one after it.
  bool accepts(const common::BatterySample& sample);

 private:
  std::string problemWith(const common::BatterySample& sample);

  std::optional<double> used_, jumped_to_;  ///< Charges, in [0, 1].
  common::Hysteresis refused_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
