// What the maneuvers that fly paths share: they need a flying vehicle, do nothing while the reactive layer retreats,
// and fly by a PathFlight.
#pragma once

#include <string>
#include <vector>

#include "autonomy/maneuvers/path_flight.hpp"

namespace swiftlet::autonomy {

class PathManeuver : public Maneuver {
 public:
  Progress step(const ManeuverInput& input) final;
  Aim aim(const common::VehicleState&) const override { return flight_.aim(); }

 protected:
  /// `purpose` completes "cannot ...": "fly to a goal".
  PathManeuver(const ManeuverSetup& setup, std::string purpose, common::FlightMode mode);

  /// At each step, also while the reactive layer retreats: what must be watched without a gap.
  virtual void watch(const ManeuverInput&) {}
  /// A step in flight without a retreat.
  virtual Progress fly(const ManeuverInput& input) = 0;
  /// Names an uncertain position as the cause before the reason of a failure; empty if the position is known.
  static std::string doubt(double drift_m);

  ManeuverSetup setup_;
  PathFlight flight_;

 private:
  std::string purpose_;
};

}  // namespace swiftlet::autonomy
