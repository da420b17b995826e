#include "autonomy/maneuvers/table.hpp"

#include <variant>

namespace swiftlet::autonomy {
namespace {

/// Stays where it stopped, until another intent comes.
class Hold final : public Maneuver {
 public:
  Progress step(const ManeuverInput&) override { return Progress::running("holding"); }
};

/// Leaves the vehicle to the reactive layer, until another intent comes.
class Avoid final : public Maneuver {
 public:
  Progress step(const ManeuverInput& input) override { return Progress::running(input.avoidance.status.reason); }
};

/// The descent without the estimate, from where the vehicle is; done on the ground.
class EmergencyLand final : public Maneuver {
 public:
  explicit EmergencyLand(control::FlightController& controller) : controller_(controller) {}
  Progress step(const ManeuverInput&) override {
    if (!control::isAirborne(controller_.state())) return Progress::done("on the ground");
    if (controller_.state() == common::FlightState::kEmergencyLanding) return Progress::running("descending");
    const auto commanded = controller_.command(control::EmergencyLand{});
    return commanded ? Progress::running("descending") : Progress::failed(commanded.error());
  }

 private:
  control::FlightController& controller_;
};

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::HoldIntent&, const ManeuverSetup&) {
  return std::make_unique<Hold>();
}

std::unique_ptr<Maneuver> maneuverFor(const common::AvoidIntent&, const ManeuverSetup&) {
  return std::make_unique<Avoid>();
}

std::unique_ptr<Maneuver> maneuverFor(const common::EmergencyLandIntent&, const ManeuverSetup& setup) {
  return std::make_unique<EmergencyLand>(setup.controller);
}

std::unique_ptr<Maneuver> makeManeuver(const common::IntentKind& kind, const ManeuverSetup& setup) {
  return std::visit([&](const auto& intent) { return maneuverFor(intent, setup); }, kind);
}

}  // namespace swiftlet::autonomy
