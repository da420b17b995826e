// The pass criteria of a trial.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/config_fwd.hpp"
#include "evaluation/figures.hpp"

namespace swiftlet::evaluation {

/// What a flight, and all flights of a trial together, must reach to pass. Criteria at their default are not checked,
/// except the first two, needless_share_max and explored_unseen_max.
class Criteria {
 public:
  bool mission_done = true;
  int collisions_max = 0;
  bool verdicts = false;
  double localized_within_m = std::numeric_limits<double>::infinity();
  bool all_resumed = true;

  /// The bound of a figure by its key in the trial file, "goal_error_max_m", which must exist.
  double& operator[](std::string_view key);
  double operator[](std::string_view key) const;
  /// Whether a figure of each flight is asked for, by its name.
  bool asksFor(std::string_view figure) const;

  void describe(common::config::Fields& fields);

 private:
  /// Those that were set. Explored, a twentieth may be left: slits, and what was looked at three times in vain.
  std::map<std::string, double, std::less<>> bounds_ = {{"needless_share_max", 0.05}, {"explored_unseen_max", 0.05}};
};

/// The figures over all flights that have a criterion of their own, but those of the verdicts.
std::vector<const TrialFigure*> judgedOverFlights();

/// The criteria of one flight that it misses, in words; for those over all flights see TrialResult::missed().
std::vector<std::string> missed(const FlightScore& flight, const Criteria& criteria);

}  // namespace swiftlet::evaluation
