// Land: lands where the vehicle is; done when it stands on the ground. In the air it cannot fail.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

class Land final : public Maneuver {
 public:
  Land(const common::LandIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;

 private:
  control::FlightController& controller_;
  tl::expected<void, std::string> commanded_;
};

}  // namespace swiftlet::autonomy
