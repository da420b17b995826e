// The checks of the health of a flight. Each is one row: what it finds, for how long that must have been so, the value
// with its bound, and the sentence for people. What follows from a finding stands in control/failsafe.
#pragma once

#include <span>
#include <string>

#include "autonomy/health/supervisor_config.hpp"
#include "common/event.hpp"
#include "common/time.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/flight_state.hpp"
#include "control/failsafe.hpp"

namespace swiftlet::autonomy {

/// Without sight of the surroundings the vehicle holds after this time. A laser at 10 Hz may lose two scans in a row
/// on its link, not three.
inline constexpr double kUnseenHold_s = 0.3;
/// The same after which it lands. What keeps a driver or a link from giving scans is over within 3 s; the rest is for
/// the first scans after it. Meanwhile the vehicle hovers by its inertial samples, and leaves walls that are near.
inline constexpr double kUnseenLand_s = 3.3;
/// Standard deviation of the position, gathered where the laser did not fix it, at which the vehicle flies back. Half
/// of a door's width is 0.45 m, and a map of walls that are off by more is no map to fly by
/// (docs/decisions/fail_safes.md#029).
inline constexpr double kDriftBack_m = 1.0;
/// The same at which it lands; in the open it flies back up to twice as much, because the trail leads inside.
inline constexpr double kDriftLand_m = 2.0;

/// The condition of the vehicle at one tick.
struct VehicleCondition {
  common::FlightState flight = common::FlightState::kPreparation;
  common::EnergyLayer energy;
  std::string gauge_fault;      ///< EnergyMonitor::gaugeFault.
  double unseen_s = 0.0;        ///< Since a sensor saw the surroundings; 0 on the ground.
  double pilot_silent_s = 0.0;  ///< Since a pilot who flies was heard of; 0 while the program flies.
  double vertical_age_s = 0.0;  ///< VehicleState::verticalAge_s.
  double drift_m = 0.0;         ///< See DriftMonitor.
  /// Whether the map has walls around the vehicle, by which the position may be found again: not so in the open.
  bool walls_around = true;
  /// Whether the state is valid and some sensor has just measured the position and the height.
  bool position_measured = false;
  /// What contradicts the inertial samples, for people; empty if nothing does.
  std::string sensor_lies;
  std::string people_all_round;  ///< Why no course is free of people, over level ground; empty if one is.
  bool lands = false;            ///< The vehicle is about to land where it is, and needs no path home.
  bool goes_home = false;        ///< The mission flies home already, and need not be told to.
};

/// A value against the bound beyond which it is a finding.
struct Reading {
  double value = 0.0;
  double bound = 0.0;
  bool beyond = false;
};

struct Finding {
  const control::Failsafe* row;  ///< Of the table, for the present phase; never null.
  Reading reading;               ///< Of now, against the bound at which it began.
  common::Time since;
  std::string why;  ///< For people, with the figures of when it last was beyond its bound.
  common::Concern concern;

  bool operator==(control::FindingKind kind) const { return row->finding == kind; }
};

/// A row. `active`: it has been found before, and its bound may be a narrower one until it ends.
struct Check {
  control::FindingKind what;
  double enter_after_s, leave_after_s;  ///< Before a take-off it counts at once.
  Reading (*read)(const VehicleCondition& condition, const SupervisorConfig& config, bool active);
  std::string (*why)(const VehicleCondition& condition, const SupervisorConfig& config);
  common::Concern concern;  ///< Of the event at its beginning.
};

/// How long the vehicle may hover before it turns back for the charge, less what giving up takes; infinite while the
/// consumption is not known.
double spareTime_s(const common::EnergyLayer& energy, const SupervisorConfig& config);

/// Those of the supervisor. Checks of the estimate itself belong to the flight controller, which works without one.
std::span<const Check> checks();

}  // namespace swiftlet::autonomy
