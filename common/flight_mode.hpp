// How fast and how closely a path is flown (Tomic 2012, "Action"). The path follower's Config has the limits of each
// mode.
#pragma once

#include <array>

namespace swiftlet::common {

enum class FlightMode { kFast, kCareful, kAccurate };
inline constexpr std::array kFlightModes{FlightMode::kFast, FlightMode::kCareful, FlightMode::kAccurate};
const char* toString(FlightMode mode);

}  // namespace swiftlet::common
