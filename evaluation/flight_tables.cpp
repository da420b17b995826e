// The tables with a row for each flight of a trial.
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Mark;
using common::Table;
using common::TableCell;
using enum FigureGroup;

TableCell verdictCell(const FlightScore& flight) {
  return {flight.verdict == Verdict::kDone ? "done"
                                           : fmt::format("{}: {}", toString(flight.verdict), flight.verdict_reason),
          acceptable(flight.verdict) ? Mark::kGood : Mark::kBad};
}

TableCell cellOf(const FlightFigure& figure, const FlightScore& flight) {
  return {figure.column.shown(figure.written(flight))};
}

std::vector<const FlightFigure*> columnsOf(std::initializer_list<FigureGroup> groups) {
  std::vector<const FlightFigure*> figures = figuresOf(groups);
  std::erase_if(figures, [](const FlightFigure* figure) { return figure->column.title == nullptr; });
  return figures;
}

}  // namespace

Table flightTable(const TrialResult& trial) {
  const auto figures = columnsOf({kCoverage, kGoals, kMission, kDistance, kEstimate, kClearance});
  const FlightFigure& speed = flightFigure("realtime_factor");
  Table table{"Flights of " + trial.name, {"seed", "passed", "outcome", "verdict"}, {}};
  for (const FlightFigure* figure : figures) table.columns.emplace_back(figure->column.title);
  for (const char* title : {"interrupted", "resumed", speed.column.title}) table.columns.emplace_back(title);
  for (const FlightScore& flight : trial.flights) {
    const std::string link = flight.folder.empty() ? "" : flight.folder + "/report.html";
    std::vector<TableCell> row = {{flight.name(), Mark::kNone, link},
                                  {flight.passed() ? "yes" : "no", flight.passed() ? Mark::kGood : Mark::kBad},
                                  {flight.outcome},
                                  verdictCell(flight)};
    for (const FlightFigure* figure : figures)
      row.push_back(figure->group == kCoverage && !flight.coverage_problem.empty() ? TableCell{"open world"}
                                                                                   : cellOf(*figure, flight));
    row.push_back({fmt::format("{}", flight.interruptions)});
    row.push_back({fmt::format("{}", flight.resumed)});
    row.push_back(cellOf(speed, flight));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table conductTable(const TrialResult& trial) {
  const auto figures = columnsOf({kConduct, kHomeEnergy, kLatency, kRawFrame});
  Table table{"Conduct and raw errors of " + trial.name, {"seed"}, {}};
  for (const FlightFigure* figure : figures) table.columns.emplace_back(figure->column.title);
  for (const FlightScore& flight : trial.flights) {
    std::vector<TableCell> row = {{flight.name()}};
    for (const FlightFigure* figure : figures) row.push_back(cellOf(*figure, flight));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table phaseTable(const TrialResult& trial) {
  Table table{"Phases of " + trial.name,
              {"seed", "phase", "time (s)", "position std (m)", "position RMS (m)", "speed (m/s)", "std",
               "yaw std (rad)", "height (m)", "std", "velocity err RMS (m/s)", "levels"},
              {}};
  for (const FlightScore& flight : trial.flights)
    for (const PhaseScore& phase : flight.phases) {
      const auto cell = [&](const char* figure, int decimals) {
        return TableCell{FigureColumn{figure, decimals}.shown(phase.figure(figure))};
      };
      table.rows.push_back({{flight.name()},
                            {phase.name, phase.missed().empty() ? Mark::kNone : Mark::kBad},
                            cell("time_s", 1),
                            cell("position_std_m", 3),
                            cell("position_rms_m", 3),
                            cell("speed_mean_m_s", 3),
                            cell("speed_std_m_s", 3),
                            cell("yaw_std_rad", 4),
                            cell("height_mean_m", 3),
                            cell("height_std_m", 3),
                            cell("velocity_error_rms_m_s", 3),
                            cell("levels", 0)});
    }
  return table;
}

}  // namespace swiftlet::evaluation
