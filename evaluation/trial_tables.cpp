// The tables of a page of trials.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "evaluation/table_cells.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Mark;
using common::Table;
using common::TableCell;

TableCell counted(int good, int all) {
  return {fmt::format("{}/{}", good, all), good == all ? Mark::kGood : Mark::kBad};
}

/// The columns of the summary for which a paper may have a figure, by their names in results.json.
struct SummaryColumn {
  const char* title;
  const char* figure;
  std::string (*show)(const std::optional<double>&);
  /// Its criterion, which is a lower bound if its name says so (`isLowerBound`); null without a criterion.
  double Criteria::*bound;
  bool where_asked = false;   ///< Shown only if a trial has the criterion, or its paper has a figure.
  const char* raw = nullptr;  ///< The figure in the raw frame; null: it has no raw figure.
};

template <int kDecimals>
std::string decimals(const std::optional<double>& value) {
  return shown(value, kDecimals);
}

const std::vector<SummaryColumn>& allColumns() {
  static const std::vector<SummaryColumn> columns = {
      {"done", "done_share", percent, &Criteria::done_share_min, true},
      {"needless", "needless_share", percent, &Criteria::needless_share_max, true},
      {"coverage min", "coverage_min", percent, &Criteria::coverage_min},
      {"goal err max (m)", "goal_error_max_m", decimals<3>, &Criteria::goal_error_max_m, false, "goal_error_max_raw_m"},
      {"median (m)", "goal_error_median_m", decimals<3>, &Criteria::goal_error_median_max_m, false,
       "goal_error_median_raw_m"},
      {"home err max (m)", "home_error_max_m", decimals<3>, &Criteria::home_error_max_m, false, "home_error_max_raw_m"},
      {"median (m)", "home_error_median_m", decimals<3>, &Criteria::home_error_median_max_m, false,
       "home_error_median_raw_m"},
      {"marker err max (m)", "marker_error_max_m", decimals<3>, &Criteria::marker_error_max_m, true},
      {"relocalization max (m)", "relocalization_error_max_m", decimals<3>, &Criteria::relocalization_error_max_m,
       true},
      {"localized", "localized_flights", percent, &Criteria::localized_flights_min, true},
      {"after, median (m)", "localization_path_length_median_m", decimals<1>, nullptr, true},
      {"wrongly, of its time", "wrong_time_share_max", percent, &Criteria::wrong_time_share_max, true},
      {"time median (s)", "mission_time_median_s", decimals<1>, &Criteria::mission_time_median_max_s},
      {"RMS median (m)", "estimate_rms_median_m", decimals<3>, &Criteria::estimate_rms_median_max_m, false,
       "estimate_rms_median_raw_m"},
      {"wall err median (m)", "map_wall_error_median_m", decimals<3>, &Criteria::map_wall_error_median_max_m, false,
       "map_wall_error_median_raw_m"},
      {"3D map err max (m)", "map3d_error_max_m", decimals<3>, &Criteria::map3d_error_max_m, true},
      {"aligned (m)", "map3d_aligned_error_max_m", decimals<3>, &Criteria::map3d_aligned_error_max_m, true},
      {"aligned 95 % (m)", "map3d_aligned_p95_max_m", decimals<3>, &Criteria::map3d_aligned_p95_max_m, true},
      {"3D coverage min", "map3d_coverage_min", percent, &Criteria::map3d_coverage_min, true},
      {"tilted, of its time", "tilted_share_max", percent, &Criteria::tilted_share_max, true},
      {"thrust margin min", "thrust_margin_min", decimals<2>, &Criteria::thrust_margin_min, true},
      {"touch-down max (m/s)", "touch_down_speed_max_m_s", decimals<2>, &Criteria::touch_down_speed_max_m_s, true},
      {"fault to safe max (s)", "safe_action_max_s", decimals<2>, &Criteria::safe_action_max_s, true},
      {"home energy err max", "home_energy_error_max", percent, &Criteria::home_energy_error_max, true},
      {"memory max (MB)", "memory_peak_MB", decimals<0>, &Criteria::memory_max_MB, true},
      {"frame at the end / start", "frame_growth_max", decimals<2>, &Criteria::frame_growth_max, true},
      {"x real time", "realtime_factor_median", decimals<1>, nullptr},
  };
  return columns;
}

const PaperFigure* paperFigure(const SummaryColumn& column, const TrialResult& trial) {
  const auto found = std::find_if(trial.paper.begin(), trial.paper.end(),
                                  [&](const PaperFigure& figure) { return figure.figure == column.figure; });
  return found == trial.paper.end() ? nullptr : &*found;
}

/// nullopt without a criterion.
std::optional<double> boundOf(const SummaryColumn& column, const Criteria& criteria) {
  if (column.bound == nullptr) return std::nullopt;
  if (column.bound == &Criteria::needless_share_max && !criteria.verdicts) return std::nullopt;
  const double bound = criteria.*column.bound;
  if (std::isinf(bound) || bound <= 0) return std::nullopt;
  return bound;
}

bool isLowerBound(double Criteria::*bound) {
  return bound == &Criteria::coverage_min || bound == &Criteria::localized_flights_min ||
         bound == &Criteria::thrust_margin_min || bound == &Criteria::map3d_coverage_min ||
         bound == &Criteria::done_share_min;
}

Mark markOf(const SummaryColumn& column, const TrialResult& trial) {
  const auto bound = boundOf(column, trial.criteria), value = trial.figure(column.figure);
  if (!bound) return Mark::kNone;
  if (!value) return Mark::kBad;
  return (isLowerBound(column.bound) ? *value >= *bound : *value <= *bound) ? Mark::kGood : Mark::kBad;
}

std::vector<SummaryColumn> columnsFor(const std::vector<TrialResult>& trials) {
  std::vector<SummaryColumn> columns;
  std::copy_if(allColumns().begin(), allColumns().end(), std::back_inserter(columns), [&](const SummaryColumn& column) {
    return !column.where_asked || std::any_of(trials.begin(), trials.end(), [&](const TrialResult& trial) {
      return boundOf(column, trial.criteria) || paperFigure(column, trial) != nullptr;
    });
  });
  return columns;
}

std::vector<TableCell> summaryRow(const TrialResult& trial, const std::vector<SummaryColumn>& columns) {
  std::vector<TableCell> row = {{trial.name}, counted(trial.passed(), trial.flown())};
  row.push_back({fmt::format("{}", trial.collisions()), trial.collisions() == 0 ? Mark::kGood : Mark::kBad});
  for (const SummaryColumn& column : columns)
    row.push_back({column.show(trial.figure(column.figure)), markOf(column, trial)});
  return row;
}

/// A row below a trial's own with a figure for some of the columns.
template <typename FigureOf>
std::vector<TableCell> rowBelow(const char* title, const std::vector<SummaryColumn>& columns, FigureOf figureOf) {
  std::vector<TableCell> row = {{title}, {""}, {""}};
  for (const SummaryColumn& column : columns) {
    const std::optional<double> figure = figureOf(column);
    row.push_back({figure ? column.show(figure) : ""});
  }
  return row;
}

bool asksForAny(const Criteria& criteria) {
  return std::any_of(allColumns().begin(), allColumns().end(),
                     [&](const SummaryColumn& column) { return boundOf(column, criteria).has_value(); });
}

std::vector<TableCell> askedRow(const TrialResult& trial, const std::vector<SummaryColumn>& columns) {
  return rowBelow("  asked for", columns, [&](const SummaryColumn& column) { return boundOf(column, trial.criteria); });
}

/// Whether the frame that the vehicle can know differs from the raw one.
bool isTurned(const TrialResult& trial) {
  constexpr double kRounding_m = 1e-6;
  const auto differ = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b && std::abs(*a - *b) > kRounding_m;
  };
  return std::any_of(trial.flights.begin(), trial.flights.end(), [&](const FlightScore& flight) {
    return differ(flight.estimate_rms_m, flight.estimate_rms_raw_m) ||
           differ(flight.goal_error_m, flight.goal_error_raw_m);
  });
}

std::vector<TableCell> rawRow(const TrialResult& trial, const std::vector<SummaryColumn>& columns) {
  return rowBelow("  in the raw frame", columns, [&](const SummaryColumn& column) -> std::optional<double> {
    return column.raw == nullptr ? std::nullopt : trial.figure(column.raw);
  });
}

std::vector<TableCell> paperRow(const TrialResult& trial, const std::vector<SummaryColumn>& columns) {
  return rowBelow("  the paper", columns, [&](const SummaryColumn& column) -> std::optional<double> {
    const PaperFigure* figure = paperFigure(column, trial);
    if (figure == nullptr) return std::nullopt;
    return figure->value;
  });
}

}  // namespace

Table summaryTable(const TrialResults& results) {
  const std::vector<SummaryColumn> columns = columnsFor(results.trials);
  Table table{"Trials", {"trial", "passed", "collisions"}, {}};
  for (const SummaryColumn& column : columns) table.columns.emplace_back(column.title);
  for (const TrialResult& trial : results.trials) {
    table.rows.push_back(summaryRow(trial, columns));
    if (isTurned(trial)) table.rows.push_back(rawRow(trial, columns));
    if (asksForAny(trial.criteria)) table.rows.push_back(askedRow(trial, columns));
    if (!trial.paper.empty()) table.rows.push_back(paperRow(trial, columns));
  }
  return table;
}

Table failureTable(const TrialResults& results) {
  Table table{"What was missed", {"trial", "seed", "criterion"}, {}};
  for (const TrialResult& trial : results.trials) {
    for (const FlightScore& flight : trial.flights)
      for (const std::string& failure : flight.failures)
        table.rows.push_back({{trial.name}, {flightName(flight)}, {failure, Mark::kBad}});
    for (const FlightScore& flight : trial.flights)
      if (!flight.passed() && flight.failures.empty())
        table.rows.push_back({{trial.name}, {flightName(flight)}, {collisionText(flight), Mark::kBad}});
    for (const std::string& failure : trial.missed())
      table.rows.push_back({{trial.name}, {"all"}, {failure, Mark::kBad}});
  }
  return table;
}

}  // namespace swiftlet::evaluation
