// The tables of a page of trials.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "evaluation/criteria.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Mark;
using common::Table;
using common::TableCell;

TableCell counted(int good, int all) {
  return {fmt::format("{}/{}", good, all), good == all ? Mark::kGood : Mark::kBad};
}

/// Of the summary.
std::vector<const TrialFigure*> allColumns() {
  using enum FigureGroup;
  std::vector<const TrialFigure*> columns;
  for (const FlightFigure* figure : figuresOf({kVerdict, kCoverage, kGoals, kLocalization, kMission, kEstimate, kMap3d,
                                               kConduct, kHomeEnergy, kMachine, kSpeed}))
    for (const TrialFigure& over_flights : figure->over_flights)
      if (over_flights.column.title != nullptr) columns.push_back(&over_flights);
  return columns;
}

const PaperFigure* paperFigure(const TrialFigure& column, const TrialResult& trial) {
  const auto found = std::find_if(trial.paper.begin(), trial.paper.end(),
                                  [&](const PaperFigure& figure) { return figure.figure == column.name; });
  return found == trial.paper.end() ? nullptr : &*found;
}

/// nullopt without a criterion.
std::optional<double> boundOf(const TrialFigure& column, const Criteria& criteria) {
  const Criterion& criterion = column.judgedBy();
  if (criterion.key == nullptr) return std::nullopt;
  if (column.name == std::string_view("needless_share") && !criteria.verdicts) return std::nullopt;
  const double bound = criteria[criterion.key];
  if (!criterion.asks(bound) || bound <= 0) return std::nullopt;
  return bound;
}

Mark markOf(const TrialFigure& column, const TrialResult& trial) {
  const auto bound = boundOf(column, trial.criteria), value = column.of(trial.flights);
  if (!bound) return Mark::kNone;
  return value && column.judgedBy().met(*value, *bound) ? Mark::kGood : Mark::kBad;
}

std::vector<const TrialFigure*> columnsFor(const std::vector<TrialResult>& trials) {
  std::vector<const TrialFigure*> columns = allColumns();
  std::erase_if(columns, [&](const TrialFigure* column) {
    return !column->column.always && std::none_of(trials.begin(), trials.end(), [&](const TrialResult& trial) {
      return boundOf(*column, trial.criteria) || paperFigure(*column, trial) != nullptr;
    });
  });
  return columns;
}

std::vector<TableCell> summaryRow(const TrialResult& trial, const std::vector<const TrialFigure*>& columns) {
  std::vector<TableCell> row = {{trial.name}, counted(trial.passed(), trial.flown())};
  row.push_back({fmt::format("{}", trial.collisions()), trial.collisions() == 0 ? Mark::kGood : Mark::kBad});
  for (const TrialFigure* column : columns)
    row.push_back({column->column.shown(column->of(trial.flights)), markOf(*column, trial)});
  return row;
}

/// A row below a trial's own with a figure for some of the columns.
template <typename FigureOf>
std::vector<TableCell> rowBelow(const char* title, const std::vector<const TrialFigure*>& columns, FigureOf figureOf) {
  std::vector<TableCell> row = {{title}, {""}, {""}};
  for (const TrialFigure* column : columns) {
    const std::optional<double> figure = figureOf(*column);
    row.push_back({figure ? column->column.shown(figure) : ""});
  }
  return row;
}

bool asksForAny(const Criteria& criteria) {
  const auto columns = allColumns();
  return std::any_of(columns.begin(), columns.end(),
                     [&](const TrialFigure* column) { return boundOf(*column, criteria).has_value(); });
}

std::vector<TableCell> askedRow(const TrialResult& trial, const std::vector<const TrialFigure*>& columns) {
  return rowBelow("  asked for", columns, [&](const TrialFigure& column) { return boundOf(column, trial.criteria); });
}

/// Whether the frame that the vehicle can know differs from the raw one.
bool isTurned(const TrialResult& trial) {
  constexpr double kRounding_m = 1e-6;
  const auto differ = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b && std::abs(*a - *b) > kRounding_m;
  };
  return std::any_of(trial.flights.begin(), trial.flights.end(), [&](const FlightScore& flight) {
    return differ(flight.figure("estimate_rms_m"), flight.figure("estimate_rms_raw_m")) ||
           differ(flight.figure("goal_error_m"), flight.figure("goal_error_raw_m"));
  });
}

/// The figure in the raw frame has `_raw` before its unit.
std::vector<TableCell> rawRow(const TrialResult& trial, const std::vector<const TrialFigure*>& columns) {
  return rowBelow("  in the raw frame", columns, [&](const TrialFigure& column) -> std::optional<double> {
    const std::string name = column.name;
    const TrialFigure* raw = findTrialFigure(name.substr(0, name.rfind('_')) + "_raw_m");
    return raw != nullptr ? raw->of(trial.flights) : std::nullopt;
  });
}

std::vector<TableCell> paperRow(const TrialResult& trial, const std::vector<const TrialFigure*>& columns) {
  return rowBelow("  the paper", columns, [&](const TrialFigure& column) -> std::optional<double> {
    const PaperFigure* figure = paperFigure(column, trial);
    if (figure == nullptr) return std::nullopt;
    return figure->value;
  });
}

}  // namespace

Table summaryTable(const TrialResults& results) {
  const std::vector<const TrialFigure*> columns = columnsFor(results.trials);
  Table table{"Trials", {"trial", "passed", "collisions"}, {}};
  for (const TrialFigure* column : columns) table.columns.emplace_back(column->column.title);
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
        table.rows.push_back({{trial.name}, {flight.name()}, {failure, Mark::kBad}});
    for (const FlightScore& flight : trial.flights)
      if (!flight.passed() && flight.failures.empty())
        table.rows.push_back({{trial.name}, {flight.name()}, {flight.collisionText(), Mark::kBad}});
    for (const std::string& failure : trial.missed())
      table.rows.push_back({{trial.name}, {"all"}, {failure, Mark::kBad}});
  }
  return table;
}

}  // namespace swiftlet::evaluation
