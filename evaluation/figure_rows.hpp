// Words to write the rows of the table of figures with; figure_table.cpp alone includes them.
#pragma once

#include <concepts>
#include <vector>

#include "evaluation/figures.hpp"
#include "evaluation/flight_score.hpp"

namespace swiftlet::evaluation {

using enum Criterion::Asked;
using enum FlightFigure::InResults;
using common::config::Bounds;
using Statistic = TrialFigure::Statistic;
using Value = std::optional<double>;

inline FigureColumn column(const char* title, int decimals = 3) { return {title, decimals}; }
inline FigureColumn percent(const char* title) { return {title, 1, 100.0, " %"}; }
inline FigureColumn milliseconds(const char* title) { return {title, 0, 1e3}; }
inline FigureColumn always(FigureColumn column) {
  column.always = true;
  return column;
}

inline Criterion atMost(const char* key, const char* label, const char* sentence, Criterion::Asked asked = kOfMission,
                        Bounds values = common::config::kPositive) {
  return {key, label, sentence, Criterion::Bound::kAtMost, asked, values};
}
inline Criterion atLeast(const char* key, const char* label, const char* sentence, Criterion::Asked asked = kOfMission,
                         Bounds values = {0, 1}, const char* why_lacking = "") {
  return {key, label, sentence, Criterion::Bound::kAtLeast, asked, values, why_lacking};
}

inline TrialFigure least(const char* name, FigureColumn column = {}, Criterion criterion = {}) {
  return {name, Statistic::kMin, column, criterion};
}
inline TrialFigure median(const char* name, FigureColumn column = {}, Criterion criterion = {}) {
  return {name, Statistic::kMedian, column, criterion};
}
inline TrialFigure greatest(const char* name, FigureColumn column = {}, Criterion criterion = {}) {
  return {name, Statistic::kMax, column, criterion};
}
inline TrialFigure mean(const char* name, FigureColumn column = {}, Criterion criterion = {}) {
  return {name, Statistic::kMean, column, criterion};
}

/// Its name within the object of its group in results.json.
inline auto key(const char* name) {
  return [name](FlightFigure& figure) { figure.key = name; };
}
/// From what a score has, not measured.
inline auto follows(Value (*of)(const FlightScore&)) {
  return [of](FlightFigure& figure) { figure.of = of; };
}

inline void put(FlightFigure& figure, FlightFigure::InResults in_results) { figure.in_results = in_results; }
inline void put(FlightFigure& figure, const FigureColumn& column) { figure.column = column; }
inline void put(FlightFigure& figure, const Criterion& criterion) { figure.criterion = criterion; }
inline void put(FlightFigure& figure, const TrialFigure& over_flights) { figure.over_flights.push_back(over_flights); }
void put(FlightFigure& figure, const std::invocable<FlightFigure&> auto& set) { set(figure); }

/// A row of its parts in any order; those over all flights are in the order of results.json.
template <typename... Parts>
FlightFigure row(const char* name, const Parts&... parts) {
  FlightFigure figure{.name = name};
  (put(figure, parts), ...);
  return figure;
}

}  // namespace swiftlet::evaluation
