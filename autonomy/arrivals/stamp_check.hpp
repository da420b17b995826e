// Refuses measurements whose stamps lie in the future. After one of them every right measurement of its sensor would
// count as older than the last, and be left out.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/sensor_event.hpp"
#include "common/stamps.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// Clocks of sensors drift apart by less in an hour (20 ppm): a stamp that is further ahead is an error.
inline constexpr common::Duration kFarAhead = common::Duration::fromMilliseconds(100);

/// Why a measurement with these stamps cannot be used, for people; null if it can. `last` is when the last usable one
/// of its sensor was measured.
inline const char* stampFault(const common::Stamps& stamps, const std::optional<common::Time>& last) {
  if (stamps.measured > stamps.arrived + kFarAhead) return "its stamp lies in the future";
  if (last && stamps.measured <= *last) return "it was not measured after the last";
  return nullptr;
}

/// One thread. The first measurement of a sensor that is refused leaves an event, and so does the first after a good
/// one.
class StampCheck {
 public:
  explicit StampCheck(common::EventLog& log) : log_(log) {}

  bool accepts(const common::SensorEvent& event);

 private:
  std::array<common::Hysteresis, std::variant_size_v<common::SensorEvent>> refused_;  ///< Of each sensor.
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
