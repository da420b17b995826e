// The true facts that a verdict rests on.
#pragma once

#include <optional>
#include <string>

namespace swiftlet::evaluation {

struct FlightRecord;
struct TrueWorld;

/// The first contact that the flight did not mean, see ContactRecord, with the true facts at its first instant.
struct ContactFacts {
  std::string what;                              ///< In words.
  bool by_person = false;                        ///< A walker touched it.
  bool yielding = false;                         ///< It stood still or moved away when the walker touched it.
  std::optional<double> person_in_field_s = {};  ///< For how long the laser could have seen the walker; nullopt: never.
  /// The person would have touched it, too, if it had stood, and if it had landed, from 2 s before.
  bool remains = false;
  bool motors_off = false;       ///< By the last setpoint.
  bool unseen_glass = false;     ///< It touched glass that had never returned a beam.
  bool room_to_take_off = true;  ///< If it was taking off: the hull fits up to the height that was requested.
  double thrust_margin = 10.0;   ///< Greatest thrust over the weight.
  /// The same at the last time at which a landing could still have been begun.
  double thrust_margin_before = 10.0;
};

/// The true facts about the end of a flight. "Then" is the last instant at which the mission ran in the air, or
/// the end of a flight that never took off: what made the vehicle give up was true by then.
struct VerdictFacts {
  bool mission_done = false;
  bool flew = false;
  bool in_the_air = false;  ///< At the end.
  bool motors_off = true;   ///< At the end; also while a pilot has them.
  bool at_home = false;     ///< It stands near the place of its take-off.
  bool inside = true;       ///< At the end walls enclose it.

  std::optional<ContactFacts> contact;

  std::string order;                 ///< The last order of operator or pilot to end the flight; empty: no order.
  std::string faulty_sensor;         ///< A sensor that the vehicle needs and that failed then; empty: no such sensor.
  double thrust_margin = 10.0;       ///< Greatest thrust over the weight then.
  double charge = 1.0;               ///< Share of the full battery then.
  double least_charge = 0.0;         ///< Charge at which the thrust margin is the least that flies safely.
  std::optional<double> home_share;  ///< Charge that the true path home takes; nullopt: there is no path.
  bool goal_reachable = true;        ///< In the true free space; also true if no goal failed.
  double position_error_m = 0.0;     ///< Of the estimate then.
  bool position_seen = true;         ///< The laser saw enough to fix the position, for some time until then.
  bool floor_seen = true;            ///< The floor below was that of the take-off or near it, for some time until then.
};

/// From the record of a flight and the true world. Computes the true free space only for a flight that ended on the
/// ground before its mission was done. Without rays in the world the places are unknown.
VerdictFacts factsOf(const FlightRecord& record, const TrueWorld& world);

// The sources of the bounds: docs/decisions/simulation.md#031.

/// Thrust at 95 % throttle over the weight below which a landing is not needless: what a draw of the nature `real` has
/// at least (config/nature/real.yaml), and the least that leaves something to climb with.
inline constexpr double kLowMargin = 1.15;
/// Charge that a vehicle may want to keep at home: lithium batteries suffer below a fifth of their charge.
inline constexpr double kReserveShare = 0.2;
/// Error of the estimate from which a landing is not needless: about the hull's diameter, so that it may miss a door.
inline constexpr double kLostPosition_m = 0.5;
/// Time in which a vehicle can notice a person and move out of the way.
inline constexpr double kNotice_s = 0.6;

}  // namespace swiftlet::evaluation
