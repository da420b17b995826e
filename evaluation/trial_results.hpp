// The results of all flights of trials: one table, one JSON file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/build_version.hpp"
#include "common/table.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/trial.hpp"

namespace swiftlet::evaluation {

/// The flights of one trial, in the order of their seeds. Several vehicles that flew together have a score each, one
/// after the other; figures over all flights are over all scores.
struct TrialResult {
  std::string name;
  std::string system;
  std::vector<PaperFigure> paper;
  std::vector<FlightScore> flights;
  Criteria criteria = {};
  std::vector<PhaseBound> figure_bounds = {};  ///< Of figures over all flights: TrialConfig::figureBounds().

  /// Flights, and those of which every vehicle passed.
  int flown() const;
  int passed() const;
  /// The criteria over all flights that are missed.
  std::vector<std::string> missed() const;
  /// At least one flew, and neither a criterion of a flight nor one over all of them is missed. A forced collision is
  /// no miss, although its flight has not passed.
  bool met() const;
  int collisions() const;  ///< All of them, the forced ones included.
  int glassContacts() const;
  /// How many flights got that verdict.
  int count(Verdict verdict) const;
  /// One of trialFigures() by its name, which must exist: over the flights that have it; nullopt without one.
  std::optional<double> figure(std::string_view figure_name) const { return trialFigure(figure_name).of(flights); }
};

struct TrialResults {
  std::vector<TrialResult> trials;
  common::BuildVersion version = {};  ///< Of the program that flew them.

  /// Every trial passed, and there is at least one.
  bool passed() const;
};

/// results.json. Figures have at most four decimals; what could not be measured is null.
std::string toJson(const TrialResults& results);

/// One row for each trial. Under it is a row with the criteria and one with the paper's figures, if there are any.
common::Table summaryTable(const TrialResults& results);

/// One row for each flight, linked to the report in its folder.
common::Table flightTable(const TrialResult& trial);

/// How each flight was flown, and its errors in the raw frame.
common::Table conductTable(const TrialResult& trial);

/// The figures of the trial's phases, one row for each flight and phase; no rows if it has none.
common::Table phaseTable(const TrialResult& trial);

/// Every criterion that was missed, by trial and seed ("all" for those over all flights); no rows if all passed.
common::Table failureTable(const TrialResults& results);

}  // namespace swiftlet::evaluation
