// The tables with a row for each flight of a trial.
#include <optional>

#include <fmt/format.h>

#include "evaluation/table_cells.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Mark;
using common::Table;
using common::TableCell;

TableCell verdictCell(const FlightScore& flight) {
  return {flight.verdict == Verdict::kDone ? "done"
                                           : fmt::format("{}: {}", toString(flight.verdict), flight.verdict_reason),
          acceptable(flight.verdict) ? Mark::kGood : Mark::kBad};
}

}  // namespace

Table flightTable(const TrialResult& trial) {
  Table table{
      "Flights of " + trial.name,
      {"seed", "passed", "outcome", "verdict", "coverage", "goal err (m)", "home err (m)", "time (s)", "distance (m)",
       "estimate RMS (m)", "wall err (m)", "clearance (m)", "interrupted", "resumed", "x real time"},
      {}};
  for (const FlightScore& flight : trial.flights) {
    const std::string link = flight.folder.empty() ? "" : flight.folder + "/report.html";
    table.rows.push_back({{flightName(flight), Mark::kNone, link},
                          {flight.passed() ? "yes" : "no", flight.passed() ? Mark::kGood : Mark::kBad},
                          {flight.outcome},
                          verdictCell(flight),
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

Table conductTable(const TrialResult& trial) {
  Table table{"Conduct and raw errors of " + trial.name,
              {"seed", "over 10 deg", "tilt max (deg)", "thrust margin", "touch-down (m/s)", "fault to safe (s)",
               "home energy told", "needed", "laser latency (ms)", "95 % (ms)", "raw goal err (m)", "raw home err (m)",
               "raw RMS (m)", "raw wall err (m)"},
              {}};
  const auto ms = [](const std::optional<double>& s) { return s ? fmt::format("{:.0f}", 1e3 * *s) : "-"; };
  for (const FlightScore& flight : trial.flights) {
    const ConductScore& conduct = flight.conduct;
    table.rows.push_back({{flightName(flight)},
                          {percent(conduct.tilted_share)},
                          {shown(conduct.tilt_max_deg, 1)},
                          {shown(conduct.thrust_margin_min, 2)},
                          {shown(conduct.touch_down_speed_m_s, 2)},
                          {shown(conduct.safe_action_s, 2)},
                          {percent(conduct.home_energy_predicted)},
                          {percent(conduct.home_energy_needed)},
                          {ms(conduct.laser_latency_median_s)},
                          {ms(conduct.laser_latency_p95_s)},
                          {shown(flight.goal_error_raw_m, 3)},
                          {shown(flight.home_error_raw_m, 3)},
                          {shown(flight.estimate_rms_raw_m, 3)},
                          {shown(flight.map_wall_error_median_raw_m, 3)}});
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
        return TableCell{shown(phase.figure(figure), decimals)};
      };
      table.rows.push_back({{flightName(flight)},
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
