// The results of all flights of trials: one table, one JSON file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/table.hpp"
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

  /// Flights, and those of which every vehicle passed.
  int flown() const;
  int passed() const;
  /// The criteria over all flights that are missed.
  std::vector<std::string> missed() const;
  /// Every flight passed, at least one flew, and no criterion over all of them is missed.
  bool met() const;
  int collisions() const;
  /// Statistics over the flights that have the figure; none if none has it.
  std::optional<double> coverageMin() const;
  std::optional<double> goalErrorMax_m() const;
  std::optional<double> goalErrorMedian_m() const;
  std::optional<double> homeErrorMax_m() const;
  std::optional<double> homeErrorMedian_m() const;
  std::optional<double> markerErrorMax_m() const;
  std::optional<double> markerErrorMedian_m() const;
  std::optional<double> relocalizationErrorMax_m() const;
  std::optional<double> relocalizationErrorMedian_m() const;
  std::optional<double> missionTimeMedian_s() const;  ///< Median over the missions that succeeded.
  std::optional<double> estimateRmsMedian_m() const;
  std::optional<double> mapWallErrorMedian_m() const;
  std::optional<double> realtimeFactorMedian() const;
  /// Share of the flights with a given map that were localized in time and rightly.
  std::optional<double> localizedFlights() const;
  std::optional<double> localizationPathLengthMedian_m() const;  ///< Median over the flights that reported a pose.
  std::optional<double> localizationPathLengthMax_m() const;
  std::optional<double> wrongTimeShareMax() const;
  /// The worst of the flights that have the figure.
  std::optional<double> tiltedShareMax() const;
  std::optional<double> thrustMarginMin() const;
  std::optional<double> touchDownSpeedMax_m_s() const;
  std::optional<double> safeActionMax_s() const;
  std::optional<double> homeEnergyErrorMax() const;
  /// In the frame of the take-off with the true heading of the body; none of them is a criterion.
  std::optional<double> goalErrorMaxRaw_m() const;
  std::optional<double> goalErrorMedianRaw_m() const;
  std::optional<double> homeErrorMaxRaw_m() const;
  std::optional<double> homeErrorMedianRaw_m() const;
  std::optional<double> estimateRmsMedianRaw_m() const;
  std::optional<double> mapWallErrorMedianRaw_m() const;
};

struct TrialResults {
  std::vector<TrialResult> trials;

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

/// Every criterion that was missed, by trial and seed ("all" for those over all flights); no rows if all passed.
common::Table failureTable(const TrialResults& results);

}  // namespace swiftlet::evaluation
