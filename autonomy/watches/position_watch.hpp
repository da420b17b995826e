// Watches whether the vehicle knows its height and position.
//
//           height unseen for height_back_s, drift over drift_back_m
//   known ------------------------------------------------------------> flying back along the trail
//     ^---------------- known again for back_known_s --------------------+        |
//                                                                                 v
//          drift over drift_land_m (in the open: twice as much), or at the end of the trail still unknown --> land
#pragma once

#include <optional>
#include <string>

#include "autonomy/watches/supervisor_config.hpp"
#include "autonomy/watches/watch_request.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// One thread. It watches while the vehicle flies; take-off and landing have rules of their own.
class PositionWatch {
 public:
  explicit PositionWatch(const SupervisorConfig& config) : config_(config) {}

  /// While it is `blind`, the rules of the SightWatch come first.
  WatchRequest watch(common::Time now, const VehicleCondition& condition, bool blind);
  /// The flight back has reached the start of the trail, or failed. Requests a landing if that did not help.
  WatchRequest backEnded();

 private:
  /// Which of height and position is unknown; empty if both are known.
  std::string unknownOf(const VehicleCondition& condition, bool blind) const;
  bool knownAgain(common::Time now, const VehicleCondition& condition);

  SupervisorConfig config_;
  std::string unknown_;
  bool flies_back_ = false;
  unsigned flights_back_ = 0;
  std::optional<common::Time> known_since_;  ///< Since when height and position have been known well.
};

}  // namespace swiftlet::autonomy
