// EmergencyLand: the descent without the estimate, from where the vehicle is; done on the ground.
#pragma once

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

class EmergencyLand final : public Maneuver {
 public:
  EmergencyLand(const common::EmergencyLandIntent&, const ManeuverSetup& setup) : setup_(setup) {}
  Progress step(const ManeuverInput&) override {
    control::FlightController& controller = setup_.controller;
    if (!control::isAirborne(controller.state())) return Progress::done("on the ground");
    if (controller.state() == common::FlightState::kEmergencyLanding) return Progress::running("descending");
    const auto commanded = controller.command(control::EmergencyLand{});
    return commanded ? Progress::running("descending") : Progress::failed(commanded.error());
  }

 private:
  ManeuverSetup setup_;
};

}  // namespace swiftlet::autonomy
