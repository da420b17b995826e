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

void Readiness::tellUnprepared(const Percept& percept) {
  unprepared_.update(true, percept.now);
  if (told_ || !unprepared_.active()) return;
  const std::string why = percept.estimator->whyUnready(percept.now);
  if (why.empty()) return;
  told_ = true;
  log_.warn(percept.now, "flight", "the vehicle is not ready to fly", why);
}

}  // namespace swiftlet::autonomy
