// The status of the reactive layer, which acts at the laser rate below every intent.
#pragma once

#include <string>

namespace swiftlet::common {

struct AvoidanceStatus {
  bool braking = false;     ///< The speed limit is below the present or the wanted speed.
  bool retreating = false;  ///< The vehicle is moved away from an obstacle that is unmapped or approaching.
  std::string reason;
  double nearest_m = 0.0;  ///< From the hull to the nearest return; infinity when there is none.
};

}  // namespace swiftlet::common
