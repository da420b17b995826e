#include "simulated_flight/trial_flight.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "behaviors/mission_check.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "evaluation/flight_scoring.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/mission_limits.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/files/unusable_folder.hpp"
#include "interfaces/run_folder.hpp"
#include "simulated_flight/flight.hpp"
#include "simulated_flight/trial_files.hpp"
#include "simulated_flight/trial_world.hpp"

namespace swiftlet::simulated_flight {
namespace {

namespace fs = std::filesystem;
using evaluation::TrialConfig;

/// The file of the map that its flights are given: beside the trial, or where data is.
void findMap(TrialConfig& trial) {
  if (trial.map.file.empty()) return;
  try {
    trial.map.file = common::findBeside(trial.folder, trial.map.file).string();
  } catch (const common::InputError& missing) {
    throw common::InputError(inTrial(trial, "map.file", trial.map.file, missing.problems().front()));
  }
}

evaluation::FlightScore scoreOf(const TrialConfig& trial, int seed, const evaluation::FlightRecord& record,
                                const simulation::SimulatedVehicle& vehicle, const interfaces::FlightEnd& end) {
  evaluation::TrueWorld truth;
  truth.rays = &vehicle.rays();
  truth.vehicle = vehicle.scenario().vehicle;
  truth.laser = vehicle.scenario().laser;
  if (const auto& camera = vehicle.scenario().rgbd_camera; camera && !camera->isStereo()) {
    truth.rgbd_camera = camera;
    const simulation::RgbdErrorsConfig& errors = vehicle.scenario().sensors.rgbd_errors;
    truth.T_body_camera = errors.T_body_camera(truth.rgbd_camera->mount);
    truth.camera_clock_offset_s = errors.clock_offset_s + 1e-6 * errors.clock_drift_ppm * record.flight_time_s;
  }
  for (const evaluation::TrialTarget& target : trial.targets)
    truth.targets.push_back({target.name, vehicle.world().boundsOf_world_m(target.model).center().cast<double>()});
  truth.quadrotor = vehicle.scenario().quadrotor;
  truth.clearance_m = trial.clearance_m;
  truth.reachable_area_max_m2 = trial.reachable_area_max_m2;
  return evaluation::scoreOf(record, truth, trial.criteria, seed, end.wall_time_s.value_or(0.0), end.machine);
}

fs::path reportIn(const fs::path& out) { return out / "report.html"; }

/// A controller that the operator switches to in flight must exist and have its model.
void checkControllers(const TrialConfig& trial, const flight::System& system, std::vector<common::Problem>& problems) {
  for (const evaluation::OperatorStep& step : trial.operator_steps) {
    if (step.command != evaluation::OperatorAction::kController) continue;
    const auto kind = control::controllerNamed(step.controller);
    const auto add = [&](const common::Message& message, const std::string& hint) {
      problems.push_back({step.place, fmt::format("trial {}: operator: controller", trial.name), message, hint});
    };
    if (!kind)
      add(common::Message("controller.unknown", "there is no `{}`", step.controller),
          common::didYouMean(step.controller, control::controllerWords()));
    else if (*kind == control::ControllerKind::kLqr)
      for (const common::Problem& problem : flight::problemsOfLqr(system))
        add(problem.message.behind(fmt::format("profile {}: ", system.name)), problem.hint);
  }
}

/// The targets that it asks for must be in its world, and its profile must look for them.
void checkTargets(const TrialConfig& trial, std::vector<common::Problem>& problems) {
  if (trial.targets.empty()) return;
  const simulation::WorldModel world = loadWorldOf(trial.scenario);
  const std::vector<std::string> models = world.modelNames();
  const flight::System system = flight::loadSystem(trial.system);
  std::vector<std::string> names = system.config.autonomy.estimator.targets.names();
  for (const perception::KnownObjectConfig& object : system.config.autonomy.estimator.recognition) {
    if (object.isPattern())
      names.push_back(object.name);
    else
      names.insert(names.end(), {"window", "door", "opening", "mirror"});
  }
  const auto check = [&](const std::vector<std::string>& known, const std::string& word, const std::string& whose) {
    if (std::find(known.begin(), known.end(), word) != known.end()) return;
    problems.push_back({{world.file},
                        fmt::format("trial {}: targets", trial.name),
                        common::Message("trial.no-target", "{} has no `{}`", whose, word),
                        common::didYouMean(word, known)});
  };
  for (const evaluation::TrialTarget& target : trial.targets) {
    check(models, target.model, "the world");
    check(names, target.name, "the profile " + trial.system);
  }
}

/// The key of each mission that is flown, and the mission.
std::vector<std::pair<std::string, std::string*>> missionsOf(TrialConfig& trial) {
  std::vector<std::pair<std::string, std::string*>> missions;
  std::vector<simulation::ScenarioVehicle>& vehicles = trial.scenario.vehicles;
  for (std::size_t i = 0; i < vehicles.size(); ++i)
    if (!vehicles[i].mission.empty())
      missions.emplace_back(fmt::format("scenario.vehicles[{}].mission", i), &vehicles[i].mission);
  if (missions.size() < std::max<std::size_t>(1, vehicles.size()))
    missions.emplace(missions.begin(), "mission", &trial.mission);
  return missions;
}

/// Finds the system and the missions, and checks what does not need the world.
void checkFiles(TrialConfig& trial, std::set<std::string>& judged_systems, const tree::Registry& types,
                std::vector<common::Problem>& problems) {
  const auto addOnce = [&](const common::Problem& problem) {  // Several conditions are of one file.
    const std::string text = toString(problem);
    if (std::none_of(problems.begin(), problems.end(), [&](const auto& told) { return toString(told) == text; }))
      problems.push_back(problem);
  };
  if (const auto missing = findSystemOf(trial)) return addOnce(*missing);
  const flight::System system = flight::loadSystem(trial.system);
  if (judged_systems.insert(trial.system).second)
    for (common::Problem& problem : flight::problemsOfSensors(system)) problems.push_back(std::move(problem));
  for (const auto& [key, mission] : missionsOf(trial)) {
    if (const auto missing = findMissionOf(trial, key, *mission))
      addOnce(*missing);
    else
      for (auto& problem : flight::missionProblems(*mission, system, trial.map.given(), types))
        problems.push_back(std::move(problem));
  }
  checkControllers(trial, system, problems);
}

}  // namespace

void prepare(std::vector<TrialConfig>& trials, const tree::Registry& types) {
  std::vector<common::Problem> problems;
  std::set<std::string> judged_systems;
  for (TrialConfig& trial : trials) checkFiles(trial, judged_systems, types, problems);
  if (!problems.empty()) throw common::InputError(std::move(problems));
  for (TrialConfig& trial : trials) {
    findMap(trial);
    findWorld(trial);
    checkTargets(trial, problems);
  }
  if (!problems.empty()) throw common::InputError(std::move(problems));
}

PlacedMap givenMap(const TrialConfig& trial, const fs::path& out) {
  if (!trial.map.given()) return {};
  if (trial.map.surveyed()) {
    const simulation::WorldModel world = loadWorldOf(trial.scenario, trial.map.survey.world);
    return surveyedMap(trial.map.survey, world, out / (trial.name + "-map"));
  }
  return {std::make_shared<const flight::FlightMap>(flight::readFlightMap(trial.map.file)),
          common::Pose2{trial.map.x_m, trial.map.y_m, trial.map.yaw_deg * common::kRadPerDeg}};
}

SimulatedSetup setupOf(const TrialConfig& trial, const PlacedMap& map, int seed, const fs::path& folder) {
  SimulatedSetup setup;
  setup.system = flight::loadSystem(trial.system);
  setup.mission_file = trial.mission;
  setup.map = map.map;
  setup.T_world_given = map.T_world_given;
  setup.scenario = trial.scenario;
  setup.scenario.seed = seed;
  setup.time_limit_s = trial.time_limit_s;
  setup.operator_steps = trial.operator_steps;
  setup.phases = trial.phases;
  setup.event_orders = trial.event_orders;
  setup.visual_odometry_alone = trial.visual_odometry_alone;
  setup.out = folder;
  return setup;
}

std::vector<evaluation::FlightScore> flyScored(const TrialConfig& trial, const SimulatedSetup& setup,
                                               SimulatedHooks hooks) {
  std::map<std::string, evaluation::FlightScore> by_name;
  hooks.score = [&](const auto& record, const auto& vehicle, interfaces::FlightEnd& end) {
    evaluation::FlightScore& score = by_name[vehicle.name()];
    score = scoreOf(trial, setup.scenario.seed, record, vehicle, end);
    score.vehicle = vehicle.name();
    end.coverage = score.figure("coverage");
    for (const auto& [name, value] : evaluation::reportedFigures(score)) end.figures.push_back({name, value});
  };
  const FlightResult result = flySimulated(setup, soundMissions(setup, setup.map != nullptr), hooks);
  if (const auto failure = result.writeFailure())
    throw common::InputError({}, "", common::Message("run.not-written", "{}", *failure));
  std::vector<evaluation::FlightScore> scores;
  for (const flight::VehicleResult& vehicle : result.vehicles) {
    scores.push_back(std::move(by_name[vehicle.name]));
    scores.back().folder = vehicle.folder.lexically_relative(setup.out.parent_path()).string();
  }
  return scores;
}

fs::path trialFolder(const std::string& given, const std::string& noun, const TrialResultsProof& proof) {
  fs::path out = given.empty() ? interfaces::freshRunFolder("runs", flight::startedNow(), noun) : fs::path(given);
  interfaces::requireWritableFolder(out, "--out");
  const fs::path results = out / proof.file;
  if ((fs::exists(results) || fs::exists(reportIn(out))) && !interfaces::saysAtStart(results, proof.text, 16))
    throw common::InputError({out.string()}, "--out",
                             common::Message("trial.other-results", "holds a report or results of something else"),
                             "give an empty or new folder");
  return out;
}

void clearOfOlderResults(const fs::path& out, const TrialResultsProof& proof) {
  fs::remove(out / proof.file);
  fs::remove(reportIn(out));
}

void checkSeeds(int first, int count) {
  const std::int64_t last = std::int64_t{first} + count - 1;
  if (static_cast<double>(last) <= simulation::kGreatestSeed) return;
  throw common::InputError(
      {}, "--seed",
      common::Message("trial.seed-too-great", "{} flights from seed {} on would end with seed {}, above {:.0f}", count,
                      first, last, simulation::kGreatestSeed),
      "begin with a lower one");
}

}  // namespace swiftlet::simulated_flight
