#include "evaluation/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/error.hpp"

namespace swiftlet::evaluation {
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

const Criterion& TrialFigure::judgedBy() const {
  const bool of_each = statistic == Statistic::kMin || statistic == Statistic::kMax;
  return of_each ? flightFigure(figure).criterion : criterion;
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

const TrialFigure* findTrialFigure(std::string_view name) {
  const auto& all = trialFigures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const TrialFigure* one) { return one->name == name; });
  return found == all.end() ? nullptr : *found;
}

const TrialFigure& trialFigure(std::string_view name) {
  const TrialFigure* found = findTrialFigure(name);
  SWIFTLET_CHECK(found != nullptr, name);
  return *found;
}

std::optional<common::Problem> trialFigureProblem(const std::string& name) {
  if (findTrialFigure(name) != nullptr) return std::nullopt;
  std::vector<std::string> names;
  for (const TrialFigure* figure : trialFigures()) names.emplace_back(figure->name);
  return common::Problem{{},
                         "",
                         common::Message("trial.no-figure", "`{}` is not a figure over all flights", name),
                         common::didYouMean(name, names)};
}

}  // namespace swiftlet::evaluation
