// The rows of the table of figures that tell how the vehicle flew, what its behaviours reached, and what the computer
// needed.
#include "evaluation/figure_rows.hpp"

namespace swiftlet::evaluation {
namespace {

template <auto kMember>
Value ofMachine(const FlightScore& flight) {
  return flight.machine.*kMember;
}

}  // namespace

/// How the vehicle was flown.
Figures conductFigures() {
  return {
      {.name = "tilted_share",
       .column = percent("over 10 deg"),
       .criterion = {"tilted_share_max", "share of the time tilted",
                     "Greatest share of the time in the air with a tilt of more than 10 deg.", kAtMost, kIfMeasured},
       .over_flights = {greatest("tilted_share_max", percent("tilted, of its time"))}},
      {.name = "tilt_max_deg", .column = {"tilt max (deg)", 1}},
      {.name = "thrust_margin_min",
       .column = {"thrust margin", 2},
       .criterion = {"thrust_margin_min", "thrust margin",
                     "Least thrust at 95 % throttle over the weight, at the least charge in the air.", kAtLeast,
                     kIfMeasured, Bounds{0, 10}},
       .over_flights = {least("thrust_margin_min", {"thrust margin min", 2})}},
      {.name = "touch_down_speed_m_s",
       .column = {"touch-down (m/s)", 2},
       .criterion = {"touch_down_speed_max_m_s", "touch-down speed, m/s", "Greatest speed of descent at a touch-down.",
                     kAtMost, kIfMeasured},
       .over_flights = {greatest("touch_down_speed_max_m_s", {"touch-down max (m/s)", 2})}},
      // Asked however the flight ended: without the figure its fault never began, and the trial tested nothing.
      {.name = "safe_action_s",
       .column = {"fault to safe (s)", 2},
       .criterion = {"safe_action_max_s", "time from fault to safe action, s",
                     "Greatest time from the beginning of a fault until the vehicle holds, lands or stands.", kAtMost,
                     kAlways},
       .over_flights = {greatest("safe_action_max_s", {"fault to safe max (s)", 2})}},
  };
}

Figures latencyFigures() {
  return {{.name = "laser_latency_median_s", .column = milliseconds("laser latency (ms)")},
          {.name = "laser_latency_p95_s", .column = milliseconds("95 % (ms)")}};
}

Figures behaviorFigures() {
  return {
      {.name = "keep_out_gap_m",
       .criterion = {"keep_out_gap_min_m", "distance from keep-out zones, m",
                     "Least distance of the hull from keep-out zones; 0 asks for nothing.", kAtLeast, kAlways,
                     Bounds{0, 100}},
       .over_flights = {least("keep_out_gap_min_m")}},
      {.name = "inspect_axis_max_deg",
       .criterion = {"inspect_axis_max_deg", "angle to the inspected point, deg",
                     "Greatest angle between the camera's axis and the point that is inspected.", kAtMost, kAlways},
       .over_flights = {greatest("inspect_axis_max_deg")}},
      {.name = "survey_coverage",
       .criterion = {"survey_coverage_min", "share of the surveyed floor that was seen",
                     "Least share of the open floor of a surveyed area that the camera has seen.", kAtLeast, kAlways,
                     kShare},
       .over_flights = {least("survey_coverage_min")}},
      {.name = "follow_share",
       .criterion = {"follow_share_min", "share of the time at the distance of following",
                     "Least share of the time of following, in each flight mode, with the person 1.5 to 3 m away.",
                     kAtLeast, kAlways, kShare},
       .over_flights = {least("follow_share_min")}},
      {.name = "follow_first_share", .over_flights = {least("follow_first_share_min")}},
      {.name = "follow_last_share", .over_flights = {least("follow_last_share_min")}},
      {.name = "follow_nearest_m"},
      {.name = "follow_farthest_m"},
      {.name = "follow_lost_s",
       .criterion = {"follow_lost_max_s", "time in which the person was lost, s",
                     "Greatest time in which the person who is followed was not within 1 m of the believed place.",
                     kAtMost, kAlways},
       .over_flights = {greatest("follow_lost_max_s")}},
      {.name = "targets_found",
       .criterion = {"targets_found_min", "share of the targets that were found",
                     "Least share of the trial's targets that are found.", kAtLeast, kAlways, kShare},
       .over_flights = {least("targets_found_min")}},
      {.name = "target_error_max_m",
       .criterion = {"target_error_max_m", "error of a target's place, m",
                     "Greatest distance of a found target from the middle of the true one.", kAtMost, kAlways},
       .over_flights = {greatest("target_error_max_m")}},
      {.name = "target_error_median_m", .over_flights = {median("target_error_median_m")}},
      {.name = "false_targets",
       .criterion = {"false_targets_max", "targets that are none",
                     "Greatest number of found targets that are none of the trial's, or are one of them again.",
                     kAtMost, kAlways, common::config::atLeast(0.0)},
       .over_flights = {greatest("false_targets_max")}},
  };
}

/// Shares of the full battery: what the vehicle predicts for the flight home when that begins, what it took by the
/// truth, and |predicted - needed| / needed.
Figures homeEnergyFigures() {
  return {
      {.name = "home_energy_predicted", .column = percent("home energy told")},
      {.name = "home_energy_needed", .column = percent("needed")},
      {.name = "home_energy_error",
       .criterion = {"home_energy_error_max", "error of the energy for the flight home",
                     "Greatest relative error of the charge that the vehicle predicts for the flight home when that "
                     "begins.",
                     kAtMost, kIfMeasured},
       .over_flights = {greatest("home_energy_error_max", percent("home energy err max"))}},
  };
}

Figures machineFigures() {
  using common::MachineUse;
  return {
      {.name = "memory_peak_MB",
       .key = "memory_peak_MB",
       .criterion = {"memory_max_MB", "memory, MB",
                     "Greatest resident memory of the program, in 10^6 bytes. Flights side by side (--jobs) share it.",
                     kAtMost, kAlways},
       .over_flights = {greatest("memory_peak_MB", {"memory max (MB)", 0})},
       .of = ofMachine<&MachineUse::memory_peak_MB>},
      {.name = "frame_first_ms", .key = "frame_first_ms", .of = ofMachine<&MachineUse::frame_first_ms>},
      {.name = "frame_last_ms", .key = "frame_last_ms", .of = ofMachine<&MachineUse::frame_last_ms>},
      {.name = "frame_growth",
       .in_results = kNot,
       .criterion = {"frame_growth_max", "camera frame at the end over one at the start",
                     "Greatest processor time of a camera frame in the 3D map, median of the last tenth of the frames "
                     "over that of the first tenth.",
                     kAtMost, kAlways},
       .over_flights = {greatest("frame_growth_max", {"frame at the end / start", 2})},
       .of = [](const FlightScore& flight) { return flight.machine.frameGrowth(); }},
      {.name = "plan_median_ms",
       .key = "plan_median_ms",
       .over_flights = {median("plan_time_median_ms")},
       .of = ofMachine<&MachineUse::plan_median_ms>},
      {.name = "plan_max_ms",
       .key = "plan_max_ms",
       .over_flights = {greatest("plan_time_max_ms")},
       .of = ofMachine<&MachineUse::plan_max_ms>},
  };
}

}  // namespace swiftlet::evaluation
