// What a mission may ask for.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace swiftlet::behaviors {

/// What the rest of the system allows a mission to ask for.
struct MissionLimits {
  /// Why the reactive layer would not let the vehicle fly with a clearance (m, between hull and obstacle); empty when
  /// it would. No function: every clearance can be flown.
  std::function<std::vector<std::string>(double clearance_m)> clearance_problems = {};
  /// Above the take-off floor.
  double max_height_m = 10.0;
  bool has_map = true;  ///< Of the place: what finds itself in one needs it.
};

}  // namespace swiftlet::behaviors
