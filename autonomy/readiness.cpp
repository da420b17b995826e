#include "autonomy/readiness.hpp"

#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

void Readiness::watch(const Percept& percept, control::FlightController& controller) {
  if (prepared_) return;
  if (percept.ready && percept.state.horizontal_valid && percept.state.vertical_valid)
    prepared_ = controller.command(control::Prepared{}).has_value();
  else
    tellUnprepared(percept);
}

/// The mission begins with a prepared vehicle: if a sensor never sends, this is the only message about it.
void Readiness::tellUnprepared(const Percept& percept) {
  constexpr double kUntilTold_s = 5.0;
  if (!unprepared_since_) unprepared_since_ = percept.now;
  if (said_ || (percept.now - *unprepared_since_).seconds() < kUntilTold_s) return;
  const std::string why = percept.estimator->whyUnready(percept.now);
  if (why.empty()) return;
  said_ = true;
  events_.push_back({percept.now, common::Severity::kWarning, "flight", "the vehicle is not ready to fly", why});
}

}  // namespace swiftlet::autonomy
