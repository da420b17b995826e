// Avoid: leaves the vehicle to the reactive layer, until another intent comes.
#pragma once

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

class Avoid final : public Maneuver {
 public:
  Avoid(const common::AvoidIntent&, const ManeuverSetup&) {}
  Progress step(const ManeuverInput& input) override { return Progress::running(input.avoidance.status.reason); }
};

}  // namespace swiftlet::autonomy
