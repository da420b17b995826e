// How long a maneuver waits for a path that is blocked, and how often it asks for one. It waits for what may go as long
// as the charge allows; the rest of the charge is for what it flies then.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "autonomy/planning_jobs/planning_worker.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// A value.
///
///   nothing failed --failed--> waits --due--> asked --failed--> waits, twice as long ...
///         ^                      | over: gives up
///         +------- reset --------+
class Patience {
 public:
  bool waits() const { return since_.has_value(); }
  /// Call it while it waits.
  common::Time since() const { return *since_; }
  /// What is in the way; nullopt if nothing that may go is.
  const std::optional<Blockage>& blockage() const { return blockage_; }

  /// A path was requested and there is none.
  void failed(common::Time now, const std::optional<Blockage>& blockage) {
    if (!since_) since_ = now;
    if (!asked_ || (now - *asked_).seconds() >= interval_s()) ++repeats_;
    asked_ = now;
    blockage_ = blockage;
  }
  void reset() { *this = {}; }

  /// The same request is worth repeating: `opened`, a cell has become free at the edge of the failed search, or the
  /// time has come.
  bool due(common::Time now, bool opened) const {
    return !asked_ || opened || (now - *asked_).seconds() >= interval_s();
  }
  /// `spare_s` is the time for which it may hover before the charge is needed for something else. What will not go is
  /// waited for only as long as the map may be about to change.
  bool over(common::Time now, double spare_s = 0.0) const {
    if (!since_) return false;
    const double waited_s = (now - *since_).seconds();
    return blockage_ ? spare_s <= 0.0 && waited_s > kPasses_s : waited_s > kWalled_s;
  }

  /// Somebody who walks through a door, or by, is gone after this time, so that much is always waited.
  static constexpr double kPasses_s = 10.0;

 private:
  /// Requests of a path are 5, 10, 20 ... s apart, so that waiting costs little.
  static constexpr double kFirst_s = 5.0;
  /// Three of these, with two looks from different places in between (Detour).
  static constexpr double kWalled_s = 35.0;
  double interval_s() const { return kFirst_s * std::exp2(std::max(0, repeats_ - 1)); }

  std::optional<common::Time> since_, asked_;
  std::optional<Blockage> blockage_;
  int repeats_ = 0;  ///< Requests after a full interval.
};

}  // namespace swiftlet::autonomy
