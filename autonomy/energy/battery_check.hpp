// Which samples of the battery are used: a landing that a single wrong one asks for is not taken back.
#pragma once

#include <optional>
#include <string>

#include "common/sensor_event.hpp"

namespace swiftlet::autonomy {

/// One thread. The current may be missing, see EnergyMonitor.
class BatteryCheck {
 public:
  /// Why the sample is not used; empty if it is. A charge that jumps is used once the next sample confirms it.
  std::string problemWith(const common::BatterySample& sample);

 private:
  std::optional<double> used_, jumped_to_;  ///< Charges, in [0, 1].
};

}  // namespace swiftlet::autonomy
