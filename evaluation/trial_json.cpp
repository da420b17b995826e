// Writes results.json.
#include <cmath>
#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "common/rounding.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using nlohmann::ordered_json;
using enum FigureGroup;

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

ordered_json valueJson(const FlightFigure& figure, const FlightScore& flight) {
  const std::optional<double> value = figure.written(flight);
  if (!value) return nullptr;
  switch (figure.in_results) {
    case FlightFigure::InResults::kCount:
      return static_cast<std::int64_t>(*value);
    case FlightFigure::InResults::kFlag:
      return *value != 0.0;
    default:
      return orNull(value);
  }
}

/// Adds the figures of the groups.
void add(std::initializer_list<FigureGroup> groups, const FlightScore& flight, ordered_json& json) {
  for (const FlightFigure* figure : figuresOf(groups))
    if (figure->in_results != FlightFigure::InResults::kNot)
      json[figure->key != nullptr ? figure->key : figure->name] = valueJson(*figure, flight);
}

ordered_json objectOf(FigureGroup group, const FlightScore& flight) {
  ordered_json json = ordered_json::object();
  add({group}, flight, json);
  return json;
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

ordered_json eventsJson(const FlightScore& flight) {
  ordered_json json = ordered_json::array();
  for (const EventOrderScore& order : flight.event_orders)
    for (const PlacedEvent& came : order.came)
      json.push_back({{"event", came.text},
                      {"time_s", orNull(came.stamp.seconds())},
                      {"place_map_m",
                       {orNull(came.place_map_m.x()), orNull(came.place_map_m.y()), orNull(came.place_map_m.z())}}});
  return json;
}

/// What only some flights have.
void addParts(const FlightScore& flight, ordered_json& json) {
  if (flight.figure("map3d_points")) json["map3d"] = objectOf(kMap3d, flight);
  if (flight.figure("camera_clock_error_s")) json["map3d"]["camera"] = objectOf(kCamera, flight);
  if (flight.figure("visual_odometry_lost_share")) json["visual_odometry"] = objectOf(kVisualOdometry, flight);
  if (flight.machine.memory_peak_MB) json["machine"] = objectOf(kMachine, flight);
  if (!flight.phases.empty()) json["phases"] = phasesJson(flight);
  if (!flight.event_orders.empty()) json["events"] = eventsJson(flight);
  if (!flight.operator_answers.empty()) json["operator"] = operatorJson(flight);
}

ordered_json flightJson(const FlightScore& flight) {
  ordered_json visits = ordered_json::array();
  for (const MarkerVisit& visit : flight.visits) visits.push_back(visitJson(visit));
  ordered_json json = {{"seed", flight.seed}};
  if (!flight.vehicle.empty()) json["vehicle"] = flight.vehicle;
  json.update(ordered_json{{"passed", flight.passed()},
                           {"outcome", flight.outcome},
                           {"failures", flight.failures},
                           {"verdict", toString(flight.verdict)},
                           {"verdict_reason", flight.verdict_reason},
                           {"folder", flight.folder},
                           {"mission_done", flight.mission_done},
                           {"collisions", flight.collisions},
                           {"avoidable_collisions", flight.avoidable_collisions},
                           {"glass_contacts", flight.glass_contacts},
                           {"collision", flight.collision}});
  add({kCoverage}, flight, json);
  json["coverage_problem"] = flight.coverage_problem;
  add({kGoals}, flight, json);
  json["visits"] = visits;
  add({kMission, kFlightTime, kDistance, kCourse, kSpace, kEstimate, kRawFrame}, flight, json);
  json["localization"] = flight.figure("localized_in_time") ? objectOf(kLocalization, flight) : ordered_json(nullptr);
  add({kClearance, kWalkers}, flight, json);
  json["interruptions"] = flight.interruptions;
  json["resumed"] = flight.resumed;
  add({kSpeed, kConduct, kHomeEnergy, kLatency}, flight, json);
  for (const FlightFigure* figure : figuresOf({kBehaviors}))
    if (flight.figure(figure->name)) json[figure->name] = valueJson(*figure, flight);
  if (!flight.certificates.empty()) json["explored"] = flight.certificates;
  addParts(flight, json);
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
  for (const TrialFigure* figure : trialFigures()) {
    std::vector<std::int64_t> seeds;
    for (const FlightScore& flight : trial.flights)
      if (!flight.figure(figure->figure)) seeds.push_back(flight.seed);
    if (!seeds.empty() && seeds.size() < trial.flights.size()) json[figure->name] = seeds;
  }
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
  for (const TrialFigure* figure : trialFigures()) json[figure->name] = orNull(figure->of(trial.flights));
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
