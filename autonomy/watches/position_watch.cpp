#include "autonomy/watches/position_watch.hpp"

#include <fmt/format.h>

namespace swiftlet::autonomy {
namespace {

/// In the open the vehicle flies back until its drift is this many times that at which it lands inside.
constexpr double kFurtherInTheOpen = 2.0;

}  // namespace

using common::Severity;
using common::Time;

WatchRequest PositionWatch::watch(Time now, const VehicleCondition& condition, bool blind) {
  WatchRequest request;
  if (condition.flight != common::FlightState::kFlying) {
    unknown_.clear();
    flies_back_ = false;
    return request;
  }
  unknown_ = unknownOf(condition, blind);
  const bool known_again = knownAgain(now, condition);
  if (!unknown_.empty() && !flies_back_) {
    flies_back_ = true;
    ++flights_back_;
    request.say(now, Severity::kWarning, "fly back along the trail", unknown_, common::Concern::kPosition);
  } else if (flies_back_ && known_again) {
    flies_back_ = false;
    request.say(now, Severity::kInfo, "height and position are known again");
  }
  if (flies_back_) request.back = flights_back_;
  // A flight back leads inside, where it can be found and where the floor is known.
  const double land_m = config_.drift_land_m * (condition.walls_around ? 1.0 : kFurtherInTheOpen);
  if (condition.drift_m > land_m) request.land = unknown_;
  return request;
}

WatchRequest PositionWatch::backEnded() {
  WatchRequest request;
  flies_back_ = false;
  if (!unknown_.empty()) request.land = unknown_ + ", also after flying back";
  return request;
}

std::string PositionWatch::unknownOf(const VehicleCondition& condition, bool blind) const {
  if (condition.vertical_age_s > config_.height_back_s && !blind)
    return fmt::format("the surface below is not measured for {:.1f} s", condition.vertical_age_s);
  if (condition.drift_m > config_.drift_back_m)
    return fmt::format("the position is uncertain by {:.1f} m", condition.drift_m);
  return {};
}

bool PositionWatch::knownAgain(Time now, const VehicleCondition& condition) {
  // The height counts as known for this long after a measurement.
  constexpr double kSeen_s = 0.15;
  // The position counts as known well up to this share of the drift at which the vehicle flies back.
  constexpr double kKnownShare = 0.5;
  const bool known = condition.vertical_age_s < kSeen_s && condition.drift_m < kKnownShare * config_.drift_back_m;
  if (!known) known_since_.reset();
  if (known && !known_since_) known_since_ = now;
  return known && (now - *known_since_).seconds() >= config_.back_known_s;
}

}  // namespace swiftlet::autonomy
