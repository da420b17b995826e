// Refuses measurements whose stamps lie in the future. After one of them every right measurement of its sensor would
// count as older than the last, and be left out.
#pragma once

#include <array>
#include <utility>
#include <variant>
#include <vector>

#include "common/event.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::autonomy {

/// One thread. The first measurement of a sensor that is refused leaves an event, and so does the first after a good
/// one.
class StampCheck {
 public:
  bool accepts(const common::SensorEvent& event);
  std::vector<common::Event> takeEvents() { return std::exchange(events_, {}); }

 private:
  std::array<bool, std::variant_size_v<common::SensorEvent>> refused_{};  ///< The last measurement of each sensor.
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
