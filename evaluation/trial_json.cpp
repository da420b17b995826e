// Writes results.json.
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "common/rounding.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using nlohmann::ordered_json;

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
          {"path_length_m", orNull(score.path_length_m)},
          {"error_m", orNull(score.error_m)},
          {"error_rad", orNull(score.error_rad)},
          {"time_share", orNull(score.time_share)},
          {"wrong_share", orNull(score.wrong_share)},
          {"times_lost", score.times_lost}};
}

ordered_json map3dJson(const Map3dScore& score) {
  ordered_json json = {{"points", score.points},
                       {"error_median_m", orNull(score.error_median_m)},
                       {"error_p95_m", orNull(score.error_p95_m)},
                       {"aligned_median_m", orNull(score.aligned_median_m)},
                       {"aligned_p95_m", orNull(score.aligned_p95_m)},
                       {"coverage", orNull(score.coverage)}};
  if (score.camera)
    json["camera"] = {{"mount_rad", orNull(score.camera->mount_rad)},
                      {"sheet_rad", orNull(score.camera->sheet_rad)},
                      {"clock_s", orNull(score.camera->clock_s)}};
  return json;
}

ordered_json machineJson(const common::MachineUse& machine) {
  return {{"memory_peak_MB", orNull(machine.memory_peak_MB)},
          {"frame_first_ms", orNull(machine.frame_first_ms)},
          {"frame_last_ms", orNull(machine.frame_last_ms)},
          {"plan_median_ms", orNull(machine.plan_median_ms)},
          {"plan_max_ms", orNull(machine.plan_max_ms)}};
}

ordered_json phasesJson(const FlightScore& flight) {
  ordered_json json = ordered_json::object();
  for (const PhaseScore& phase : flight.phases)
    for (const auto& [name, figure] : phase.figures) json[phase.name][name] = orNull(figure);
  return json;
}

ordered_json operatorJson(const FlightScore& flight) {
  ordered_json json = ordered_json::array();
  for (const OperatorAnswer& answer : flight.operator_answers)
    json.push_back({{"command", answer.command},
                    {"time_s", answer.given ? orNull(answer.given->seconds()) : ordered_json(nullptr)},
                    {"accepted", answer.accepted ? ordered_json(*answer.accepted) : ordered_json(nullptr)},
                    {"reason", answer.reason}});
  return json;
}

ordered_json flightJson(const FlightScore& flight) {
  ordered_json visits = ordered_json::array();
  for (const MarkerVisit& visit : flight.visits) visits.push_back(visitJson(visit));
  ordered_json json = {{"seed", flight.seed}};
  if (!flight.vehicle.empty()) json["vehicle"] = flight.vehicle;
  json.update(ordered_json{
      {"passed", flight.passed()},
      {"outcome", flight.outcome},
      {"failures", flight.failures},
      {"verdict", toString(flight.verdict)},
      {"verdict_reason", flight.verdict_reason},
      {"folder", flight.folder},
      {"mission_done", flight.mission_done},
      {"collisions", flight.collisions},
      {"avoidable_collisions", flight.avoidable_collisions},
      {"glass_contacts", flight.glass_contacts},
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
      {"end_distance_m", orNull(flight.end_distance_m)},
      {"speed_max_m_s", orNull(flight.speed_max_m_s)},
      {"explored_area_m2", orNull(flight.explored_area_m2)},
      {"reachable_area_m2", orNull(flight.reachable_area_m2)},
      {"estimate_rms_m", orNull(flight.estimate_rms_m)},
      {"estimate_spatial_rms_m", orNull(flight.estimate_spatial_rms_m)},
      {"estimate_yaw_rms_rad", orNull(flight.estimate_yaw_rms_rad)},
      {"map_wall_error_median_m", orNull(flight.map_wall_error_median_m)},
      {"map_wall_error_p95_m", orNull(flight.map_wall_error_p95_m)},
      {"goal_error_raw_m", orNull(flight.goal_error_raw_m)},
      {"home_error_raw_m", orNull(flight.home_error_raw_m)},
      {"estimate_rms_raw_m", orNull(flight.estimate_rms_raw_m)},
      {"map_wall_error_median_raw_m", orNull(flight.map_wall_error_median_raw_m)},
      {"localization", flight.localization ? localizationJson(*flight.localization) : ordered_json(nullptr)},
      {"min_clearance_m", orNull(flight.min_clearance_m)},
      {"min_walker_clearance_m", orNull(flight.min_walker_clearance_m)},
      {"interruptions", flight.interruptions},
      {"resumed", flight.resumed},
      {"realtime_factor", orNull(flight.realtime_factor)}});
  for (const auto& [name, figure] : figuresOf(flight.conduct)) json[name] = orNull(figure);
  for (const auto& [name, figure] : figuresOf(flight.behaviors))
    if (figure) json[name] = orNull(figure);
  if (flight.map3d) json["map3d"] = map3dJson(*flight.map3d);
  if (flight.visual_odometry)
    json["visual_odometry"] = {{"rms_m", orNull(flight.visual_odometry->rms_m)},
                               {"lost_share", orNull(flight.visual_odometry->lost_share)}};
  if (flight.machine.memory_peak_MB) json["machine"] = machineJson(flight.machine);
  if (!flight.phases.empty()) json["phases"] = phasesJson(flight);
  if (!flight.operator_answers.empty()) json["operator"] = operatorJson(flight);
  return json;
}

/// Only those that a flight got.
ordered_json verdictsJson(const TrialResult& trial) {
  ordered_json json = ordered_json::object();
  for (int i = 0; i <= static_cast<int>(Verdict::kUnfinished); ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (const int count = trial.count(verdict); count > 0) json[toString(verdict)] = count;
  }
  return json;
}

/// Of figures that some flights lack, which are ignored there.
ordered_json seedsWithoutJson(const TrialResult& trial) {
  ordered_json json = ordered_json::object();
  for (const TrialFigure& figure : trialFigures())
    if (const auto seeds = seedsWithout(figure, trial.flights); !seeds.empty() && seeds.size() < trial.flights.size())
      json[figure.name] = seeds;
  return json;
}

ordered_json trialJson(const TrialResult& trial) {
  ordered_json flights = ordered_json::array(), paper = ordered_json::object();
  for (const FlightScore& flight : trial.flights) flights.push_back(flightJson(flight));
  for (const PaperFigure& figure : trial.paper) paper[figure.figure] = figure.value;
  ordered_json json = {{"name", trial.name},
                       {"system", trial.system},
                       {"runs", trial.flown()},
                       {"passed", trial.passed()},
                       {"met", trial.met()},
                       {"failures", trial.missed()},
                       {"collisions", trial.collisions()},
                       {"glass_contacts", trial.glassContacts()},
                       {"verdicts", verdictsJson(trial)}};
  for (const TrialFigure& figure : trialFigures()) json[figure.name] = orNull(valueOf(figure, trial.flights));
  json["seeds_without"] = seedsWithoutJson(trial);
  json["paper"] = paper;
  json["flights"] = flights;
  return json;
}

}  // namespace

std::string toJson(const TrialResults& results) {
  ordered_json trials = ordered_json::array();
  for (const TrialResult& trial : results.trials) trials.push_back(trialJson(trial));
  const common::BuildVersion& version = results.version;
  // The trials are first: by them the file is recognized.
  return ordered_json{{"trials", trials},
                      {"version", version.number},
                      {"commit", version.commit},
                      {"dirty", version.dirty ? ordered_json(*version.dirty) : ordered_json()}}
             .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace swiftlet::evaluation
