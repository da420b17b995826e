// TakeOff: climbs to the intent's height; done when it hovers there. A vehicle that flies already is done at once; one
// whose thrust or charge does not suffice fails with the figure. One that would not know its height or position waits a
// little with its motors off, and fails.
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "autonomy/maneuvers/maneuver.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "common/hysteresis.hpp"

namespace swiftlet::autonomy {
namespace {

using common::FlightState;

class TakeOff final : public Maneuver {
 public:
  TakeOff(const common::TakeOffIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;

 private:
  std::optional<Progress> waiting(const ManeuverInput& input);
  void begin(const ManeuverInput& input);

  common::TakeOffIntent intent_;
  control::FlightController& controller_;
  FlightMemory& memory_;
  bool begun_ = false;
  common::Hysteresis waits_;  ///< For sensors that can carry a flight.
  tl::expected<void, std::string> commanded_;
};

TakeOff::TakeOff(const common::TakeOffIntent& intent, const ManeuverSetup& setup)
    : intent_(intent), controller_(setup.controller), memory_(setup.memory) {}

Progress TakeOff::step(const ManeuverInput& input) {
  if (!begun_) {
    if (!control::isAirborne(controller_.state()) && !input.take_off_refusal.empty())
      return Progress::failed("take-off refused: " + input.take_off_refusal);
    if (auto wait = waiting(input)) return *wait;
    begin(input);
  }
  if (!commanded_)
    return control::isAirborne(controller_.state()) ? cannot("take off", controller_)
                                                    : Progress::failed(commanded_.error());
  switch (controller_.state()) {
    case FlightState::kFlying:
      return Progress::done("at the take-off height");
    case FlightState::kTakingOff:
    case FlightState::kLanded:
      return Progress::running();
    case FlightState::kPreparation:
    case FlightState::kPoweredOff:
    case FlightState::kLanding:
    case FlightState::kEmergencyLanding:
      break;
  }
  return cannot("take off", controller_);
}

/// A laser whose motor has just started, or a person who steps aside, may change what is seen.
std::optional<Progress> TakeOff::waiting(const ManeuverInput& input) {
  constexpr double kLongest_s = 5.0;
  if (control::isAirborne(controller_.state())) return std::nullopt;
  const std::string problem = input.unready();
  if (problem.empty()) return std::nullopt;
  if (waits_.update(true, input.now) == common::Edge::kEntered)
    memory_.log.warn(input.now, kFlightSource, "take-off delayed", problem);
  if (waits_.active_s(input.now) > kLongest_s) return Progress::failed("take-off refused: " + problem);
  return Progress::running("take-off delayed: " + problem);
}

void TakeOff::begin(const ManeuverInput& input) {
  begun_ = true;
  memory_.cruise_height_m = intent_.height_m;  // In flight, too: the next path leads to it.
  if (controller_.state() == FlightState::kFlying || controller_.state() == FlightState::kTakingOff) return;
  memory_.stood_map_m = input.state.horizontal_valid ? std::optional(input.position_map_m()) : std::nullopt;
  commanded_ = controller_.command(control::TakeOff{intent_.height_m});
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::TakeOffIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<TakeOff>(intent, setup);
}

}  // namespace swiftlet::autonomy
