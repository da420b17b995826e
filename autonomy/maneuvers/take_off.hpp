// TakeOff: climbs to the intent's height; done when it hovers there. A vehicle that flies already is done at once.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

class TakeOff final : public Maneuver {
 public:
  TakeOff(const common::TakeOffIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;

 private:
  control::FlightController& controller_;
  tl::expected<void, std::string> commanded_;
};

}  // namespace swiftlet::autonomy
