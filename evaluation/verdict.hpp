// The verdict on a flight, from three things: the truth, what the autonomy published that it was doing, and the faults
// of the scenario. What the vehicle says of the reasons does not count.
#pragma once

#include <string>

namespace swiftlet::evaluation {

struct VerdictFacts;

enum class Verdict {
  kDone,        ///< The mission was done.
  kHome,        ///< It came home early and stands there, for a reason that the truth confirms.
  kLanded,      ///< It landed inside before the mission's end, for a reason that the truth confirms.
  kRefused,     ///< It never took off, for a reason that the truth confirms.
  kForced,      ///< It touched something, and no flying could have prevented that.
  kStruck,      ///< A person walked into it while it stood still or moved away, and it had time to evade.
  kNeedless,    ///< It landed or never took off, and the truth shows no reason for it.
  kCrashed,     ///< It touched something, be it the floor, where it meant to fly.
  kOutside,     ///< It landed where nothing encloses it: it has left the building.
  kUnfinished,  ///< It was in the air, or its motors were on, when the flight was ended by the time limit or from
                ///< outside.
};
/// "done", "home", ...: as in results.json.
const char* toString(Verdict verdict);

/// Whether the vehicle has done what was possible: the first five.
bool acceptable(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::kUnfinished;
  std::string reason;  ///< What the truth says, with figures.
};

Judgement judge(const VerdictFacts& facts);

}  // namespace swiftlet::evaluation
