// The envelope of a trial: each quantity of the plant turned up alone, from its value in a base, until flights fail.
// This file has what is turned up, and the search; flights are flown by the caller.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "evaluation/flight_score.hpp"
#include "simulation/nature.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::evaluation {

/// A number of the plant, and the value up to which it is turned.
struct EnvelopeQuantity {
  std::string key;
  double to = std::numeric_limits<double>::quiet_NaN();
  std::string name;

  void describe(common::config::Fields& fields);
  /// Refuses keys that are not numbers of the plant, and values out of the key's bounds.
  std::vector<common::Problem> validate() const;
};

struct EnvelopeConfig {
  std::string base = "nominal";
  int seeds = 5;
  int steps = 4;
  int bisections = 3;
  std::vector<EnvelopeQuantity> quantities;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// A file such as config/envelope.yaml. A quantity without a name is named by its key. Throws common::InputError with
/// file, line and column.
EnvelopeConfig readEnvelope(const std::filesystem::path& file);

/// The scenario in the base with everything pinned: the wind is the base's, and the charge that of the scenario, or
/// that of the base if the scenario does not write it out. What the seed varies otherwise, the start and the obstacles,
/// it varies as before.
simulation::Scenario pinned(const simulation::Scenario& scenario, const simulation::Nature& base);

/// The value of a quantity in a pinned scenario. Throws common::InputError if the base draws it from a range, or if it
/// is EnvelopeQuantity::to already.
double baseValue(const EnvelopeQuantity& quantity, const simulation::Scenario& pinned);

/// How one flight ended.
struct EnvelopeFlight {
  std::int64_t seed = 0;
  bool acceptable = false;
  std::string verdict;                 ///< As in results.json: "done", "crashed".
  std::string ending;                  ///< In words, with what was touched or why.
  std::optional<double> goal_error_m;  ///< nullopt if no goal was reached.
  std::string folder;                  ///< Of its run, relative to the report; empty if it was not kept.
};

/// `scores` has one for each vehicle. The flight is acceptable if the verdict on each vehicle is; otherwise the first
/// that is not gives the ending.
EnvelopeFlight envelopeFlight(const std::vector<FlightScore>& scores);

/// The flights at one value, in the order of their seeds. After the first that is not acceptable no more are flown.
struct EnvelopeStep {
  double value = 0.0;
  std::vector<EnvelopeFlight> flights;

  /// At least one flew, and all were.
  bool acceptable() const;
};

/// What was flown for one quantity. The first step is the base.
struct EnvelopeFinding {
  EnvelopeQuantity quantity;
  double from = 0.0;                ///< The value in the base.
  std::vector<EnvelopeStep> steps;  ///< In the order of their values, from the base on.
  bool complete = false;            ///< The search has ended.

  /// Inserts a step at its place.
  void add(EnvelopeStep step);
  /// Where a value lies: 0 at the base, 1 at the end of the range.
  double share(double value) const { return (value - from) / (quantity.to - from); }
  /// The first step that is not acceptable; null if all are.
  const EnvelopeStep* firstFailing() const;
  /// The farthest value that was flown so that it and all nearer ones were acceptable; nullopt if the base was not.
  std::optional<double> acceptableTo() const;
  /// Values beyond the first failing one at which all flights were acceptable again: the boundary is not sharp, or the
  /// range behind it was not flown densely enough.
  std::vector<double> acceptableBeyond() const;
};

/// The next value to fly, given what has been flown: first `steps` values at equal distances up to the end, so that
/// monotony is not assumed, then `bisections` values between the first failing one and its acceptable neighbour.
/// nullopt when that is done, when no value fails, or when the base itself fails. At most `steps` + `bisections` values
/// are flown. Without state: the same steps have the same next value.
std::optional<double> nextValue(const EnvelopeFinding& finding, const EnvelopeConfig& config);

}  // namespace swiftlet::evaluation
