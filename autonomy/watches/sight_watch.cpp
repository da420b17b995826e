#include "autonomy/watches/sight_watch.hpp"

#include <fmt/format.h>

#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::Severity;

WatchRequest SightWatch::watch(common::Time now, const VehicleCondition& condition) {
  WatchRequest request;
  const double unseen_s = last_sight_ && control::isAirborne(condition.flight) ? (now - *last_sight_).seconds() : 0.0;
  const bool blind = unseen_s > config_.unseen_hold_s;
  if (blind && !blind_)
    request.say(now, Severity::kWarning, "hold",
                fmt::format("no scan for {:.2f} s{}", unseen_s,
                            condition.position_measured ? "; other sensors measure the position" : ""),
                common::Concern::kSurroundings);
  if (!blind && blind_) request.say(now, Severity::kInfo, "scans are back");
  blind_ = blind;
  if (blind) request.hold = "the laser is silent";
  const double land_s = condition.position_measured ? config_.unseen_known_land_s : config_.unseen_land_s;
  if (unseen_s > land_s) request.land = fmt::format("no scan for {:.1f} s", unseen_s);
  return request;
}

}  // namespace swiftlet::autonomy
