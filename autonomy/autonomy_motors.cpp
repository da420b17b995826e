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

void Autonomy::prepare() {
  if (prepared_ || !estimator_.ready()) return;
  const common::VehicleState state = estimator_.state();
  if (!state.horizontal_valid || !state.vertical_valid) return;
  prepared_ = controller_.command(control::Prepared{}).has_value();
}

}  // namespace swiftlet::autonomy
