// When a vehicle that stands is ready for its mission.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "autonomy/percept.hpp"
#include "common/event.hpp"
#include "common/time.hpp"

namespace swiftlet::control {
class FlightController;
}

namespace swiftlet::autonomy {

/// One thread. Ready once, it stays so.
class Readiness {
 public:
  /// Prepares the controller once height and position are known. To be called at each tick.
  void watch(const Percept& percept, control::FlightController& controller);

  bool prepared() const { return prepared_; }
  /// Why the vehicle is not ready after some seconds, once.
  std::vector<common::Event> takeEvents() { return std::exchange(events_, {}); }

 private:
  void tellUnprepared(const Percept& percept);

  bool prepared_ = false;
  std::optional<common::Time> unprepared_since_;
  bool said_ = false;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
