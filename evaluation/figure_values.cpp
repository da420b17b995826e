// The values of figures in the scores of flights.
#include <limits>

#include <fmt/format.h>

#include "common/quantile.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

double statisticOf(TrialFigure::Statistic statistic, const std::vector<double>& values) {
  switch (statistic) {
    case TrialFigure::Statistic::kMin:
      return common::quantile(values, 0.0);
    case TrialFigure::Statistic::kMedian:
      return common::quantile(values, 0.5);
    case TrialFigure::Statistic::kMax:
      return common::quantile(values, 1.0);
    case TrialFigure::Statistic::kMean:
      return statisticsOf(values).mean;
  }
  return 0.0;
}

}  // namespace

std::optional<double> TrialFigure::of(const std::vector<FlightScore>& flights) const {
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    if (const std::optional<double> value = flight.figure(figure)) values.push_back(*value);
  if (values.empty()) return std::nullopt;
  return statisticOf(statistic, values);
}

std::string TrialFigure::failure(const std::vector<FlightScore>& flights, double limit) const {
  if (criterion.asked == Criterion::Asked::kIfMeasured) return criterion.failure(of(flights), limit);
  std::vector<double> values;
  std::size_t lacking = 0;
  for (const FlightScore& flight : flights) {
    const std::optional<double> value = flight.figure(figure);
    lacking += value ? 0 : 1;
    values.push_back(value.value_or(std::numeric_limits<double>::max()));
  }
  if (values.empty()) return criterion.failure(std::nullopt, limit);
  if (criterion.asks(limit) && 2 * lacking >= values.size())
    return fmt::format("{}: {} of {} flights lack the figure, at most {:g} was asked for", criterion.label, lacking,
                       values.size(), limit);
  return criterion.failure(statisticOf(statistic, values), limit);
}

std::optional<double> FlightFigure::written(const FlightScore& flight) const {
  const std::optional<double> value = flight.figure(name);
  return !value && in_results == InResults::kOrZero ? 0.0 : value;
}

}  // namespace swiftlet::evaluation
