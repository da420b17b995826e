// TakeOff: climbs to the intent's height; done when it hovers there. A vehicle that flies already is done at once; one
// whose thrust or charge does not suffice fails with the figure.
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
  void begin(const ManeuverInput& input);

  common::TakeOffIntent intent_;
  control::FlightController& controller_;
  FlightMemory& memory_;
  bool begun_ = false;
  tl::expected<void, std::string> commanded_;
};

}  // namespace swiftlet::autonomy
