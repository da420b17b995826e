// The verdict on a flight: whether a flight that did not do its mission had a reason for it, judged with the truth and
// never by the vehicle's own word.
#pragma once

#include <optional>
#include <string>

namespace swiftlet::evaluation {

struct FlightRecord;
struct TrueWorld;

enum class Verdict {
  kDone,        ///< The mission was done.
  kHome,        ///< It came home early and stands there, for a reason that the truth confirms.
  kLanded,      ///< It landed inside before the mission's end, for a reason that the truth confirms.
  kRefused,     ///< It never took off, for a reason that the truth confirms.
  kForced,      ///< It crashed, and no flying could have prevented that.
  kStruck,      ///< A person walked into it while it stood still or moved away.
  kUnseen,      ///< It touched glass that had never returned a beam.
  kNeedless,    ///< It landed or never took off, and the truth shows no reason for it.
  kCrashed,     ///< It crashed, and could have prevented it.
  kOutside,     ///< It landed where nothing encloses it: it has left the building.
  kUnfinished,  ///< It was still in the air when the flight was ended, by the time limit or from outside.
};
/// "done", "home", ...: as in results.json.
const char* toString(Verdict verdict);

/// Whether the vehicle has done what was possible: the first seven.
bool acceptable(Verdict verdict);

/// The true facts about the end of a flight. "Then" is the last instant at which the mission ran in the air, or
/// the end of a flight that never took off: what made the vehicle give up was true by then.
struct VerdictFacts {
  bool mission_done = false;
  bool flew = false;
  bool in_the_air = false;  ///< At the end.
  bool at_home = false;     ///< It stands near the place of its take-off.
  bool inside = true;       ///< At the end walls enclose it.

  bool crashed = false;
  std::string contact;           ///< In words.
  bool by_person = false;        ///< A walker touched it.
  bool yielding = false;         ///< It stood still or moved away when it was touched.
  bool unseen_glass = false;     ///< It touched glass that had never returned a beam.
  bool room_to_take_off = true;  ///< The hull fits above the take-off place.
  double contact_margin = 10.0;  ///< Greatest thrust over the weight at the contact.
  /// Greatest thrust over the weight at the last time at which a landing could still have been begun.
  double landing_margin = 10.0;

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

struct Judgement {
  Verdict verdict = Verdict::kUnfinished;
  std::string reason;  ///< What the truth says, with figures.
};

/// From the record of a flight and the true world. Computes the true free space only for a flight that ended on the
/// ground before its mission was done. Without rays in the world the places are unknown.
VerdictFacts factsOf(const FlightRecord& record, const TrueWorld& world);

Judgement judge(const VerdictFacts& facts);

// The sources of the bounds: docs/decisions/simulation.md#031.

/// Thrust at 95 % throttle over the weight below which a landing is not needless: what a draw of the nature `real` has
/// at least (config/nature/real.yaml), and the least that leaves something to climb with.
inline constexpr double kLowMargin = 1.15;
/// Charge that a vehicle may want to keep at home: lithium batteries suffer below a fifth of their charge.
inline constexpr double kReserveShare = 0.2;
/// Error of the estimate from which a landing is not needless: about the hull's diameter, so that it may miss a door.
inline constexpr double kLostPosition_m = 0.5;

}  // namespace swiftlet::evaluation
