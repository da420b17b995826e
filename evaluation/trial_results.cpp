#include "evaluation/trial_results.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/rounding.hpp"
#include "evaluation/judge.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Mark;
using common::Table;
using common::TableCell;
using nlohmann::ordered_json;

/// The figure of the flights that have it.
template <typename Member>
std::vector<double> figures(const std::vector<FlightScore>& flights, Member member) {
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    if (const std::optional<double> value = flight.*member) values.push_back(*value);
  return values;
}

template <typename Member>
std::optional<double> atQuantile(const std::vector<FlightScore>& flights, Member member, double q) {
  const std::vector<double> values = figures(flights, member);
  if (values.empty()) return std::nullopt;
  return quantile(values, q);
}

constexpr double kMin = 0.0, kMedian = 0.5, kMax = 1.0;

std::optional<double> localizationWay_m(const std::vector<FlightScore>& flights, double q) {
  std::vector<double> ways_m;
  for (const FlightScore& flight : flights)
    if (flight.localization && flight.localization->way_m) ways_m.push_back(*flight.localization->way_m);
  if (ways_m.empty()) return std::nullopt;
  return quantile(ways_m, q);
}

ordered_json orNull(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(common::rounded(*value)) : ordered_json(nullptr);
}

ordered_json visitJson(const MarkerVisit& visit) {
  const auto pair = [](const Eigen::Vector2d& v) { return ordered_json{orNull(v.x()), orNull(v.y())}; };
  return {{"time_s", orNull(visit.stamp.seconds())},
          {"marker_map_m", pair(visit.marker_map_m)},
          {"estimate_error_m", pair(visit.estimate_error_m)},
          {"open_loop_error_m", visit.open_loop_error_m ? pair(*visit.open_loop_error_m) : ordered_json(nullptr)}};
}

ordered_json localizationJson(const LocalizationScore& score) {
  return {{"in_time", score.in_time},
          {"way_m", orNull(score.way_m)},
          {"error_m", orNull(score.error_m)},
          {"error_rad", orNull(score.error_rad)},
          {"time_share", orNull(score.time_share)},
          {"wrong_share", orNull(score.wrong_share)},
          {"times_lost", score.times_lost}};
}

ordered_json flightJson(const FlightScore& flight) {
  ordered_json visits = ordered_json::array();
  for (const MarkerVisit& visit : flight.visits) visits.push_back(visitJson(visit));
  return {{"seed", flight.seed},
          {"passed", flight.passed()},
          {"outcome", flight.outcome},
          {"failures", flight.failures},
          {"folder", flight.folder},
          {"mission_done", flight.mission_done},
          {"collisions", flight.collisions},
          {"avoidable_collisions", flight.avoidable_collisions},
          {"collision", flight.collision},
          {"coverage", orNull(flight.coverage)},
          {"coverage_problem", flight.coverage_problem},
          {"goal_error_m", orNull(flight.goal_error_m)},
          {"home_error_m", orNull(flight.home_error_m)},
          {"marker_error_m", orNull(flight.marker_error_m)},
          {"relocalization_error_m", orNull(flight.relocalization_error_m)},
          {"open_loop_error_m", orNull(flight.open_loop_error_m)},
          {"visits", visits},
          {"mission_time_s", orNull(flight.mission_time_s)},
          {"flight_time_s", orNull(flight.flight_time_s)},
          {"distance_m", orNull(flight.distance_m)},
          {"speed_max_m_s", orNull(flight.speed_max_m_s)},
          {"explored_area_m2", orNull(flight.explored_area_m2)},
          {"reachable_area_m2", orNull(flight.reachable_area_m2)},
          {"estimate_rms_m", orNull(flight.estimate_rms_m)},
          {"estimate_spatial_rms_m", orNull(flight.estimate_spatial_rms_m)},
          {"estimate_yaw_rms_rad", orNull(flight.estimate_yaw_rms_rad)},
          {"map_wall_error_median_m", orNull(flight.map_wall_error_median_m)},
          {"map_wall_error_p95_m", orNull(flight.map_wall_error_p95_m)},
          {"localization", flight.localization ? localizationJson(*flight.localization) : ordered_json(nullptr)},
          {"min_clearance_m", orNull(flight.min_clearance_m)},
          {"min_walker_clearance_m", orNull(flight.min_walker_clearance_m)},
          {"interruptions", flight.interruptions},
          {"resumed", flight.resumed},
          {"realtime_factor", orNull(flight.realtime_factor)}};
}

ordered_json trialJson(const TrialResult& trial) {
  ordered_json flights = ordered_json::array(), paper = ordered_json::object();
  for (const FlightScore& flight : trial.flights) flights.push_back(flightJson(flight));
  for (const PaperFigure& figure : trial.paper) paper[figure.figure] = figure.value;
  return {{"name", trial.name},
          {"system", trial.system},
          {"runs", trial.flights.size()},
          {"passed", trial.passed()},
          {"met", trial.met()},
          {"failures", trial.missed()},
          {"collisions", trial.collisions()},
          {"coverage_min", orNull(trial.coverageMin())},
          {"goal_error_max_m", orNull(trial.goalErrorMax_m())},
          {"goal_error_median_m", orNull(trial.goalErrorMedian_m())},
          {"home_error_max_m", orNull(trial.homeErrorMax_m())},
          {"home_error_median_m", orNull(trial.homeErrorMedian_m())},
          {"marker_error_max_m", orNull(trial.markerErrorMax_m())},
          {"marker_error_median_m", orNull(trial.markerErrorMedian_m())},
          {"relocalization_error_max_m", orNull(trial.relocalizationErrorMax_m())},
          {"relocalization_error_median_m", orNull(trial.relocalizationErrorMedian_m())},
          {"mission_time_median_s", orNull(trial.missionTimeMedian_s())},
          {"estimate_rms_median_m", orNull(trial.estimateRmsMedian_m())},
          {"map_wall_error_median_m", orNull(trial.mapWallErrorMedian_m())},
          {"localized_flights", orNull(trial.localizedFlights())},
          {"localization_way_median_m", orNull(trial.localizationWayMedian_m())},
          {"localization_way_max_m", orNull(trial.localizationWayMax_m())},
          {"wrong_time_share_max", orNull(trial.wrongTimeShareMax())},
          {"realtime_factor_median", orNull(trial.realtimeFactorMedian())},
          {"paper", paper},
          {"flights", flights}};
}

std::string shown(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string percent(const std::optional<double>& value) { return value ? fmt::format("{:.1f} %", 100 * *value) : "-"; }

TableCell counted(int good, int all) {
  return {fmt::format("{}/{}", good, all), good == all ? Mark::kGood : Mark::kBad};
}

/// The columns of the summary that a paper may have a figure for, by the names of results.json.
struct SummaryColumn {
  const char* title;
  const char* figure;
  std::string (*show)(const std::optional<double>&);
  std::optional<double> (TrialResult::*value)() const;
  /// Of the criterion on it, a lower one for coverage and an upper one otherwise; null: there is none.
  double Criteria::*bound;
  bool where_asked = false;  ///< Shown only where a trial asks for it, or its paper has a figure.
};

template <int kDecimals>
std::string decimals(const std::optional<double>& value) {
  return shown(value, kDecimals);
}

const std::vector<SummaryColumn>& allColumns() {
  static const std::vector<SummaryColumn> columns = {
      {"coverage min", "coverage_min", percent, &TrialResult::coverageMin, &Criteria::coverage_min},
      {"goal err max (m)", "goal_error_max_m", decimals<3>, &TrialResult::goalErrorMax_m, &Criteria::goal_error_max_m},
      {"median (m)", "goal_error_median_m", decimals<3>, &TrialResult::goalErrorMedian_m,
       &Criteria::goal_error_median_max_m},
      {"home err max (m)", "home_error_max_m", decimals<3>, &TrialResult::homeErrorMax_m, &Criteria::home_error_max_m},
      {"median (m)", "home_error_median_m", decimals<3>, &TrialResult::homeErrorMedian_m,
       &Criteria::home_error_median_max_m},
      {"marker err max (m)", "marker_error_max_m", decimals<3>, &TrialResult::markerErrorMax_m,
       &Criteria::marker_error_max_m, true},
      {"relocalization max (m)", "relocalization_error_max_m", decimals<3>, &TrialResult::relocalizationErrorMax_m,
       &Criteria::relocalization_error_max_m, true},
      {"localized", "localized_flights", percent, &TrialResult::localizedFlights, &Criteria::localized_flights_min,
       true},
      {"after, median (m)", "localization_way_median_m", decimals<1>, &TrialResult::localizationWayMedian_m, nullptr,
       true},
      {"wrongly, of its time", "wrong_time_share_max", percent, &TrialResult::wrongTimeShareMax,
       &Criteria::wrong_time_share_max, true},
      {"time median (s)", "mission_time_median_s", decimals<1>, &TrialResult::missionTimeMedian_s,
       &Criteria::mission_time_median_max_s},
      {"RMS median (m)", "estimate_rms_median_m", decimals<3>, &TrialResult::estimateRmsMedian_m,
       &Criteria::estimate_rms_median_max_m},
      {"wall err median (m)", "map_wall_error_median_m", decimals<3>, &TrialResult::mapWallErrorMedian_m,
       &Criteria::map_wall_error_median_max_m},
      {"x real time", "realtime_factor_median", decimals<1>, &TrialResult::realtimeFactorMedian, nullptr},
  };
  return columns;
}

const PaperFigure* paperFigure(const SummaryColumn& column, const TrialResult& trial) {
  const auto found = std::find_if(trial.paper.begin(), trial.paper.end(),
                                  [&](const PaperFigure& figure) { return figure.figure == column.figure; });
  return found == trial.paper.end() ? nullptr : &*found;
}

/// None where nothing is asked for.
std::optional<double> boundOf(const SummaryColumn& column, const Criteria& criteria) {
  if (column.bound == nullptr) return std::nullopt;
  const double bound = criteria.*column.bound;
  if (std::isinf(bound) || bound <= 0) return std::nullopt;
  return bound;
}

Mark markOf(const SummaryColumn& column, const TrialResult& trial) {
  const auto bound = boundOf(column, trial.criteria), value = (trial.*column.value)();
  if (!bound) return Mark::kNone;
  if (!value) return Mark::kBad;
  const bool at_least = column.bound == &Criteria::coverage_min || column.bound == &Criteria::localized_flights_min;
  return (at_least ? *value >= *bound : *value <= *bound) ? Mark::kGood : Mark::kBad;
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
  const int runs = static_cast<int>(trial.flights.size());
  std::vector<TableCell> row = {{trial.name}, counted(trial.passed(), runs)};
  row.push_back({fmt::format("{}", trial.collisions()), trial.collisions() == 0 ? Mark::kGood : Mark::kBad});
  for (const SummaryColumn& column : columns)
    row.push_back({column.show((trial.*column.value)()), markOf(column, trial)});
  return row;
}

/// A row under a trial's own with a figure for some of the columns.
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

std::vector<TableCell> paperRow(const TrialResult& trial, const std::vector<SummaryColumn>& columns) {
  return rowBelow("  the paper", columns, [&](const SummaryColumn& column) -> std::optional<double> {
    const PaperFigure* figure = paperFigure(column, trial);
    if (figure == nullptr) return std::nullopt;
    return figure->value;
  });
}

}  // namespace

int TrialResult::passed() const {
  return static_cast<int>(std::count_if(flights.begin(), flights.end(), [](const auto& f) { return f.passed(); }));
}

std::vector<std::string> TrialResult::missed() const {
  Judge judge;
  judge.atMost("goal error median, m", goalErrorMedian_m(), criteria.goal_error_median_max_m);
  judge.atMost("home error median, m", homeErrorMedian_m(), criteria.home_error_median_max_m);
  judge.atMost("mission time median, s", missionTimeMedian_s(), criteria.mission_time_median_max_s);
  judge.atMost("estimate RMS median, m", estimateRmsMedian_m(), criteria.estimate_rms_median_max_m);
  judge.atMost("map wall error median, m", mapWallErrorMedian_m(), criteria.map_wall_error_median_max_m);
  judge.atLeast("flights localized", localizedFlights(), criteria.localized_flights_min, "no flight was given a map");
  return judge.failures;
}

bool TrialResult::met() const {
  return !flights.empty() && passed() == static_cast<int>(flights.size()) && missed().empty();
}

int TrialResult::collisions() const {
  int sum = 0;
  for (const FlightScore& flight : flights) sum += flight.collisions;
  return sum;
}

std::optional<double> TrialResult::coverageMin() const { return atQuantile(flights, &FlightScore::coverage, kMin); }
std::optional<double> TrialResult::goalErrorMax_m() const {
  return atQuantile(flights, &FlightScore::goal_error_m, kMax);
}
std::optional<double> TrialResult::goalErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::goal_error_m, kMedian);
}
std::optional<double> TrialResult::homeErrorMax_m() const {
  return atQuantile(flights, &FlightScore::home_error_m, kMax);
}
std::optional<double> TrialResult::homeErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::home_error_m, kMedian);
}
std::optional<double> TrialResult::markerErrorMax_m() const {
  return atQuantile(flights, &FlightScore::marker_error_m, kMax);
}
std::optional<double> TrialResult::markerErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::marker_error_m, kMedian);
}
std::optional<double> TrialResult::relocalizationErrorMax_m() const {
  return atQuantile(flights, &FlightScore::relocalization_error_m, kMax);
}
std::optional<double> TrialResult::relocalizationErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::relocalization_error_m, kMedian);
}
std::optional<double> TrialResult::missionTimeMedian_s() const {
  std::vector<FlightScore> done;
  std::copy_if(flights.begin(), flights.end(), std::back_inserter(done), [](const auto& f) { return f.mission_done; });
  return atQuantile(done, &FlightScore::mission_time_s, kMedian);
}
std::optional<double> TrialResult::estimateRmsMedian_m() const {
  return atQuantile(flights, &FlightScore::estimate_rms_m, kMedian);
}
std::optional<double> TrialResult::mapWallErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::map_wall_error_median_m, kMedian);
}
std::optional<double> TrialResult::realtimeFactorMedian() const {
  return atQuantile(flights, &FlightScore::realtime_factor, kMedian);
}

std::optional<double> TrialResult::localizedFlights() const {
  int given = 0, in_time = 0;
  for (const FlightScore& flight : flights) {
    given += flight.localization ? 1 : 0;
    in_time += flight.localization && flight.localization->in_time ? 1 : 0;
  }
  if (given == 0) return std::nullopt;
  return static_cast<double>(in_time) / given;
}
std::optional<double> TrialResult::localizationWayMedian_m() const { return localizationWay_m(flights, kMedian); }
std::optional<double> TrialResult::localizationWayMax_m() const { return localizationWay_m(flights, kMax); }
std::optional<double> TrialResult::wrongTimeShareMax() const {
  std::optional<double> greatest;
  for (const FlightScore& flight : flights)
    if (flight.localization) greatest = std::max(flight.localization->wrong_share, greatest.value_or(0.0));
  return greatest;
}

bool TrialResults::passed() const {
  return !trials.empty() && std::all_of(trials.begin(), trials.end(), [](const auto& trial) { return trial.met(); });
}

std::string toJson(const TrialResults& results) {
  ordered_json trials = ordered_json::array();
  for (const TrialResult& trial : results.trials) trials.push_back(trialJson(trial));
  return ordered_json{{"trials", trials}}.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Table summaryTable(const TrialResults& results) {
  const std::vector<SummaryColumn> columns = columnsFor(results.trials);
  Table table{"Trials", {"trial", "passed", "collisions"}, {}};
  for (const SummaryColumn& column : columns) table.columns.emplace_back(column.title);
  for (const TrialResult& trial : results.trials) {
    table.rows.push_back(summaryRow(trial, columns));
    if (asksForAny(trial.criteria)) table.rows.push_back(askedRow(trial, columns));
    if (!trial.paper.empty()) table.rows.push_back(paperRow(trial, columns));
  }
  return table;
}

Table flightTable(const TrialResult& trial) {
  Table table{"Flights of " + trial.name,
              {"seed", "passed", "outcome", "coverage", "goal err (m)", "home err (m)", "time (s)", "distance (m)",
               "estimate RMS (m)", "wall err (m)", "clearance (m)", "interrupted", "resumed", "x real time"},
              {}};
  for (const FlightScore& flight : trial.flights) {
    const std::string link = flight.folder.empty() ? "" : flight.folder + "/report.html";
    table.rows.push_back({{fmt::format("{}", flight.seed), Mark::kNone, link},
                          {flight.passed() ? "yes" : "no", flight.passed() ? Mark::kGood : Mark::kBad},
                          {flight.outcome},
                          {flight.coverage_problem.empty() ? percent(flight.coverage) : "open world"},
                          {shown(flight.goal_error_m, 3)},
                          {shown(flight.home_error_m, 3)},
                          {shown(flight.mission_time_s, 1)},
                          {shown(flight.distance_m, 1)},
                          {shown(flight.estimate_rms_m, 3)},
                          {shown(flight.map_wall_error_median_m, 3)},
                          {shown(flight.min_clearance_m, 2)},
                          {fmt::format("{}", flight.interruptions)},
                          {fmt::format("{}", flight.resumed)},
                          {shown(flight.realtime_factor, 1)}});
  }
  return table;
}

Table failureTable(const TrialResults& results) {
  Table table{"What was missed", {"trial", "seed", "criterion"}, {}};
  for (const TrialResult& trial : results.trials) {
    for (const FlightScore& flight : trial.flights)
      for (const std::string& failure : flight.failures)
        table.rows.push_back({{trial.name}, {fmt::format("{}", flight.seed)}, {failure, Mark::kBad}});
    for (const std::string& failure : trial.missed())
      table.rows.push_back({{trial.name}, {"all"}, {failure, Mark::kBad}});
  }
  return table;
}

}  // namespace swiftlet::evaluation
