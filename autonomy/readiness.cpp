#include "autonomy/readiness.hpp"

#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

void Readiness::watch(const Percept& percept, control::FlightController& controller) {
  if (prepared_) return;
  unprepared_.update(true, percept.now);
  // A sample of the battery that is lost is followed by another. Where none comes, the check of the take-off says so.
  const bool measured = percept.battery_v > 0.0 || unprepared_.active();
  if (percept.ready && percept.state.horizontal_valid && percept.state.vertical_valid && measured)
    prepared_ = controller.command(control::Prepared{}).has_value();
  else
    tellUnprepared(percept);
}

void Readiness::tellUnprepared(const Percept& percept) {
  if (told_ || !unprepared_.active()) return;
  const std::string why = percept.estimator->whyUnready(percept.now);
  if (why.empty()) return;
  told_ = true;
  log_.warn(percept.now, "flight", "the vehicle is not ready to fly", why);
}

}  // namespace swiftlet::autonomy
