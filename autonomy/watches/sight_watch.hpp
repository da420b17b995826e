// Watches whether the surroundings are seen: a short blindness holds the vehicle, a long one lands it.
//
//   seen --unseen_hold_s without sight--> hold --unseen_land_s without sight--> land
//     ^-------------- sight ---------------+
//
// As long as something else measures the position, the vehicle can hold its place, and lands later: after
// unseen_known_land_s.
#pragma once

#include <optional>

#include "autonomy/watches/supervisor_config.hpp"
#include "autonomy/watches/watch_request.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// One thread. On the ground blindness requests nothing.
class SightWatch {
 public:
  explicit SightWatch(const SupervisorConfig& config) : config_(config) {}

  /// A sensor of obstacles saw the surroundings: today a usable scan of the laser.
  void surroundingsSeen(common::Time now) { last_sight_ = now; }
  WatchRequest watch(common::Time now, const VehicleCondition& condition);

 private:
  SupervisorConfig config_;
  std::optional<common::Time> last_sight_;
  bool blind_ = false;
};

}  // namespace swiftlet::autonomy
