// The figures over all flights of a trial: of each flight's figure the least, the median, the greatest or the mean.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/flight_score.hpp"

namespace swiftlet::evaluation {

enum class Statistic { kMin, kMedian, kMax, kMean };

struct TrialFigure {
  const char* name;  ///< As in results.json: "goal_error_max_m".
  Statistic statistic;
  std::optional<double> (*of)(const FlightScore&);  ///< nullopt if the flight lacks it; it is then ignored.
};

/// In the order of results.json.
const std::vector<TrialFigure>& trialFigures();

/// Why there is no figure of that name, with the most similar one; empty if there is.
std::string trialFigureProblem(const std::string& name);

/// nullopt if no flight has the figure.
std::optional<double> valueOf(const TrialFigure& figure, const std::vector<FlightScore>& flights);
/// By its name, which must exist.
std::optional<double> trialFigure(std::string_view name, const std::vector<FlightScore>& flights);

/// The seeds of the flights that lack the figure.
std::vector<std::int64_t> seedsWithout(const TrialFigure& figure, const std::vector<FlightScore>& flights);

/// The median over all flights, where one that lacks the figure counts as worse than any that has it; nullopt without
/// flights.
std::optional<double> medianOverAll(std::optional<double> FlightScore::*figure,
                                    const std::vector<FlightScore>& flights);

}  // namespace swiftlet::evaluation
