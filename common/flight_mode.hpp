// How fast and how closely a path is flown (Tomic 2012, "Action"). The path follower's Config has the limits of each
// mode.
#pragma once

namespace swiftlet::common {

enum class FlightMode { kFast, kCareful, kAccurate };
const char* toString(FlightMode mode);

}  // namespace swiftlet::common
