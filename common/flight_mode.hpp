// How boldly a path is flown (Tomic 2012, "Action"); the limits of each mode are the path follower's configuration.
#pragma once

namespace swiftlet::common {

enum class FlightMode { kFast, kCareful, kAccurate };
const char* toString(FlightMode mode);

}  // namespace swiftlet::common
