// How fast and how closely a path is flown (Tomic 2012, "Action"). The path follower's Config has the limits of each
// mode.
#pragma once

#include <array>

namespace swiftlet::common {

/// `kFast` is the default of a mission. `kBrisk` is for behaviours that need more speed, such as following a person
/// who walks at 1 m/s.
enum class FlightMode { kFast, kCareful, kAccurate, kBrisk };
inline constexpr std::array kFlightModes{FlightMode::kFast, FlightMode::kCareful, FlightMode::kAccurate,
                                         FlightMode::kBrisk};
const char* toString(FlightMode mode);

}  // namespace swiftlet::common
