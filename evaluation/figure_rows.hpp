// Words for writing the rows of the table of figures. Only its sources include it.
#pragma once

#include <vector>

#include "evaluation/figures.hpp"
#include "evaluation/flight_score.hpp"

namespace swiftlet::evaluation {

using enum Criterion::Bound;
using enum Criterion::Asked;
using enum FlightFigure::InResults;
using enum TrialFigure::Statistic;
using common::config::Bounds;
using Figures = std::vector<FlightFigure>;
using Value = std::optional<double>;

inline constexpr Bounds kShare{0, 1};

inline FigureColumn percent(const char* title) { return {title, 1, 100.0, " %"}; }
inline FigureColumn milliseconds(const char* title) { return {title, 0, 1e3}; }

inline TrialFigure least(const char* name, FigureColumn column = {}) { return {name, kMin, column}; }
inline TrialFigure median(const char* name, FigureColumn column = {}) { return {name, kMedian, column}; }
inline TrialFigure greatest(const char* name, FigureColumn column = {}) { return {name, kMax, column}; }
inline TrialFigure mean(const char* name, FigureColumn column = {}) { return {name, kMean, column}; }

inline TrialFigure judged(TrialFigure figure, Criterion criterion) {
  figure.criterion = criterion;
  return figure;
}
inline TrialFigure always(TrialFigure figure) {
  figure.always_shown = true;
  return figure;
}

Figures conductFigures();
Figures latencyFigures();
Figures behaviorFigures();
Figures homeEnergyFigures();
Figures machineFigures();

}  // namespace swiftlet::evaluation
