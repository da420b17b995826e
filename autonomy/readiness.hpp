// When a vehicle that stands is ready for its mission.
#pragma once

#include <optional>

#include "autonomy/percept.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"

namespace swiftlet::control {
class FlightController;
}

namespace swiftlet::autonomy {

/// One thread. Ready once, it stays so.
class Readiness {
 public:
  explicit Readiness(common::EventLog& log) : log_(log) {}

  /// Prepares the controller once height and position are known and the battery is measured, or no sample of it came
  /// for long. To be called at each tick.
  void watch(const Percept& percept, control::FlightController& controller);

  bool prepared() const { return prepared_; }

 private:
  /// The mission begins with a prepared vehicle: if a sensor never sends, one event after this time tells of it.
  static constexpr double kUntilTold_s = 5.0;
  void tellUnprepared(const Percept& percept);

  bool prepared_ = false;
  common::Hysteresis unprepared_{kUntilTold_s};
  bool told_ = false;  ///< Why it is not ready, once.
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
