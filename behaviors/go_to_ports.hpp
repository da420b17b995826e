// The ports of a leaf that flies to places: how near, how clear of obstacles and in which mode.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "behaviors/flight_tick.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "common/intent.hpp"

namespace swiftlet::behaviors {

class GoToPorts {
 public:
  /// The manifest must have tolerancePort(), shiftPort(), clearancePort() and modePort().
  explicit GoToPorts(const tree::NodeSetup& setup)
      : tolerance_m_(setup, "tolerance_m"),
        shift_m_(setup, "shift_m"),
        clearance_m_(setup, "clearance_m"),
        mode_(setup, "mode") {}

  /// The intent to fly to a place that the mission names, in the present mode if the port is not set; or which port has
  /// no value, or that the place is one of a given map whose pose is not known. The place is not judged.
  tl::expected<common::GoToIntent, std::string> intentTo(const tree::Point& place, const FlightTick& tick,
                                                         common::FlightMode present) const {
    const auto tolerance_m = tolerance_m_.get();
    const auto shift_m = shift_m_.get();
    const auto clearance_m = clearance_m_.get();
    const auto mode = modeOr(mode_, present);
    if (!tolerance_m) return tl::unexpected(tolerance_m_.problem());
    if (!shift_m) return tl::unexpected(shift_m_.problem());
    if (!clearance_m) return tl::unexpected(clearance_m_.problem());
    if (!mode) return tl::unexpected(mode_.problem());
    const auto places = NamedPlaces::in(*tick.flight.world);
    if (!places) return tl::unexpected(places.error());
    common::GoToIntent intent;
    intent.goal_map_m = places->inMap_m(place);
    if (places->given()) intent.goal_given_m = Eigen::Vector2d(place.x, place.y);
    intent.height_m = place.z;
    intent.tolerance_m = *tolerance_m;
    intent.shift_m = *shift_m;
    intent.shift_after_s = kMayGo_s;
    intent.clearance_m = *clearance_m;
    intent.mode = *mode;
    return intent;
  }

 private:
  /// An obstacle at the goal that has not been cleared from the map after this time is likely to stay.
  static constexpr double kMayGo_s = 5.0;

  tree::Input<double> tolerance_m_;
  tree::Input<double> shift_m_;
  tree::Input<double> clearance_m_;
  tree::Input<std::string> mode_;
};

}  // namespace swiftlet::behaviors
