#include "evaluation/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/error.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

double statisticOf(TrialFigure::Statistic statistic, const std::vector<double>& values) {
  switch (statistic) {
    case TrialFigure::Statistic::kMin:
      return quantile(values, 0.0);
    case TrialFigure::Statistic::kMedian:
      return quantile(values, 0.5);
    case TrialFigure::Statistic::kMax:
      return quantile(values, 1.0);
    case TrialFigure::Statistic::kMean:
      return statisticsOf(values).mean;
  }
  return 0.0;
}

}  // namespace

double Criterion::unasked() const { return bound == Bound::kAtMost ? std::numeric_limits<double>::infinity() : 0.0; }

bool Criterion::asks(double limit) const { return bound == Bound::kAtMost ? !std::isinf(limit) : limit > 0.0; }

std::string Criterion::failure(const std::optional<double>& value, double limit, const std::string& problem) const {
  if (!asks(limit) || (value && met(*value, limit))) return {};
  const bool at_most = bound == Bound::kAtMost;
  const std::string why = problem.empty() ? why_lacking : problem;
  const std::string measured = !value    ? "not measured" + (why.empty() ? "" : ": " + why)
                               : at_most ? fmt::format("{:.3f}", *value)
                                         : fmt::format("{:.4f}", *value);
  return fmt::format("{}: {}, at {} {:g} was asked for", label, measured, at_most ? "most" : "least", limit);
}

std::string FigureColumn::shown(const std::optional<double>& value) const {
  return value ? fmt::format("{:.{}f}{}", factor * *value, decimals, unit) : "-";
}

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

const Criterion& TrialFigure::judgedBy() const {
  const bool of_each = statistic == Statistic::kMin || statistic == Statistic::kMax;
  return of_each ? flightFigure(figure).criterion : criterion;
}

std::optional<double> FlightFigure::written(const FlightScore& flight) const {
  const std::optional<double> value = flight.figure(name);
  return !value && in_results == InResults::kOrZero ? 0.0 : value;
}

std::vector<const FlightFigure*> figuresOf(std::initializer_list<FigureGroup> groups) {
  std::vector<const FlightFigure*> figures;
  for (const FigureGroup group : groups)
    for (const FlightFigure& figure : flightFigures())
      if (figure.group == group) figures.push_back(&figure);
  return figures;
}

const FlightFigure& flightFigure(std::string_view name) {
  const auto& all = flightFigures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const FlightFigure& one) { return one.name == name; });
  SWIFTLET_CHECK(found != all.end(), name);
  return *found;
}

const std::vector<const TrialFigure*>& trialFigures() {
  static const std::vector<const TrialFigure*> figures = [] {
    std::vector<const TrialFigure*> all;
    for (const FlightFigure& figure : flightFigures())
      for (const TrialFigure& over_flights : figure.over_flights) all.push_back(&over_flights);
    return all;
  }();
  return figures;
}

const TrialFigure& trialFigure(std::string_view name) {
  const auto& all = trialFigures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const TrialFigure* one) { return one->name == name; });
  SWIFTLET_CHECK(found != all.end(), name);
  return **found;
}

std::string trialFigureProblem(const std::string& name) {
  std::vector<std::string> names;
  for (const TrialFigure* figure : trialFigures()) names.emplace_back(figure->name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  return toString(common::Problem{
      {}, "", fmt::format("`{}` is not a figure over all flights", name), common::didYouMean(name, names)});
}

}  // namespace swiftlet::evaluation
