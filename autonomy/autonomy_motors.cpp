// When the vehicle is ready to take off, and when its motors rest.
#include "autonomy/autonomy.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::Time;

/// A vehicle that stands and is not to take off has its motors off, also while its mission waits for somebody who comes
/// to change the battery.
void Autonomy::restMotors(Time now) {
  // A take-off right after a landing should not find them off.
  constexpr double kUntilRest_s = 1.0;
  const bool takes_off = std::holds_alternative<common::TakeOffIntent>(intent_.kind);
  if (controller_.state() != FlightState::kLanded || (takes_off && !missionOver())) {
    stands_since_.reset();
    return;
  }
  if (!stands_since_) stands_since_ = now;
  if (missionOver() || (now - *stands_since_).seconds() >= kUntilRest_s)
    (void)controller_.command(control::DisengageMotors{});
}

void Autonomy::prepare(Time now) {
  if (prepared_) return;
  const common::VehicleState state = estimator_.state();
  if (estimator_.ready() && state.horizontal_valid && state.vertical_valid)
    prepared_ = controller_.command(control::Prepared{}).has_value();
  else
    tellUnprepared(now);
}

/// The mission begins with a prepared vehicle: where a sensor never sends, nothing else would say why it does not.
void Autonomy::tellUnprepared(Time now) {
  constexpr double kUntilTold_s = 5.0;
  if (!unprepared_since_) unprepared_since_ = now;
  if (unprepared_said_ || (now - *unprepared_since_).seconds() < kUntilTold_s) return;
  const std::string why = estimator_.whyUnready(now);
  if (why.empty()) return;
  unprepared_said_ = true;
  events_.push_back({now, common::Severity::kWarning, "flight", "the vehicle is not ready to fly", why});
}

}  // namespace swiftlet::autonomy
