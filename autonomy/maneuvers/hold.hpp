// Hold: stays where it stopped, until another intent comes.
#pragma once

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

class Hold final : public Maneuver {
 public:
  Hold(const common::HoldIntent&, const ManeuverSetup&) {}
  Progress step(const ManeuverInput&) override { return Progress::running("holding"); }
};

}  // namespace swiftlet::autonomy
