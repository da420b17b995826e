// TakeOff: climbs to the intent's height; done when it hovers there. A vehicle that flies already is done at once; one
// whose thrust or charge does not suffice fails with the figure. One that would not know its height or position waits a
// little with its motors off, and fails.
#pragma once

#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

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
  std::optional<common::Time> waits_since_;  ///< For sensors that can carry a flight.
  tl::expected<void, std::string> commanded_;
};

}  // namespace swiftlet::autonomy
