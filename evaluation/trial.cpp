#include "evaluation/trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/config_fields.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"
#include "evaluation/figures.hpp"

namespace swiftlet::evaluation {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using common::Problem;

bool isTrialFile(const fs::path& path) { return path.extension() == ".yaml" || path.extension() == ".yml"; }

/// A name without control characters, and no longer than the name of a folder may be.
bool canBeSeen(const std::string& name) {
  return name.size() <= 100 &&
         std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; });
}

bool hasEmpty(const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), "") != names.end();
}

/// A step for a vehicle that does not fly would never be given.
void checkVehicles(const TrialConfig& trial, common::Validation& validation) {
  std::vector<std::string> names;
  for (const simulation::ScenarioVehicle& vehicle : trial.scenario.vehicles) names.push_back(vehicle.name);
  for (const OperatorStep& step : trial.operator_steps) {
    const bool flies = step.vehicle.empty() || std::find(names.begin(), names.end(), step.vehicle) != names.end();
    validation.require(flies, "operator", Message("scenario.no-vehicle", "there is no vehicle `{}`", step.vehicle),
                       names.empty() ? "the one that flies has no name" : common::didYouMean(step.vehicle, names));
  }
}

void checkPhases(const std::vector<PhaseConfig>& phases, common::Validation& validation) {
  std::set<std::string> names;
  for (const PhaseConfig& phase : phases)
    validation.require(names.insert(phase.name).second, "phases",
                       Message("trial.phase-twice", "`{}` is the name of two of them", phase.name));
}

/// The criteria of one system must name phases and figures that exist.
void checkBounds(const TrialConfig& trial, const SystemBounds& of_one, common::Validation& validation) {
  validation.require(trial.flies(of_one.system), "asked_of",
                     Message("trial.no-system", "`{}` is not one of the systems", of_one.system));
  for (const PhaseBounds& of_phase : of_one.phases) {
    const auto phase = std::find_if(trial.phases.begin(), trial.phases.end(),
                                    [&](const PhaseConfig& one) { return one.name == of_phase.phase; });
    validation.require(phase != trial.phases.end(), "asked_of",
                       Message("trial.no-phase", "there is no phase `{}`", of_phase.phase));
    if (phase == trial.phases.end()) continue;
    for (const PhaseBound& bound : of_phase.criteria)
      validation.refuse("asked_of", phaseFigureProblem(*phase, bound.figure));
  }
}

}  // namespace

void PaperFigure::describe(common::config::Fields& fields) {
  fields("figure", figure, "Name of the figure, as in the results: goal_error_max_m.");
  fields("value", value, common::config::kFinite, "Value that the paper reports.");
}

std::vector<common::Problem> PaperFigure::validate() const {
  common::Validation validation;
  if (figure.empty()) return validation.given(false, "figure").problems();
  return validation.refuse("figure", trialFigureProblem(figure)).problems();
}

void TrialMap::describe(common::config::Fields& fields) {
  fields("file", file, "YAML of map_server, relative to the root of the software; empty for none.");
  fields("x_m", x_m, {-1e4, 1e4}, "Position of the origin of the file's frame along the world's x.");
  fields("y_m", y_m, {-1e4, 1e4}, "Position of the origin of the file's frame along the world's y.");
  fields("yaw_deg", yaw_deg, {-360, 360}, "Rotation of the file's frame in the world.");
  fields.section("survey", survey, "A robot on wheels that makes the map before the first flight.");
}

std::vector<common::Problem> TrialMap::validate() const {
  return common::Validation()
      .require(file.empty() || !surveyed(), "file",
               Message("trial.two-maps", "is given, and a `survey` that makes another map, too"))
      .problems();
}

void TrialConfig::describe(common::config::Fields& fields) {
  fields("name", name, "Name for tables and folders; that of the file when none is given.");
  fields("description", description, "What is flown and why.");
  fields("mission", mission, "XML file, relative to the root of the software.");
  fields("system", system, "System profile.");
  fields("systems", systems,
         "System profiles, instead of `system`: each of them is flown, a paper's and our own for instance.");
  fields("natures", natures,
         "How far the vehicle is from its data sheet: calm, real, harsh, or a file; each of them is flown.");
  fields("batteries", batteries, {0.01, 1},
         "Charges at the start, as shares of the full one; each of them is flown. Empty: that of scenario and nature.");
  fields("each_fault", each_fault,
         "Whether each fault of the scenario is flown by itself, instead of all of them in every flight.");
  fields("archive", archive,
         "The world's archive below the folder of data sets; empty when the world is with the software.");
  fields("repeat", repeat, {1, 10'000}, "Flights, each with the next seed.");
  fields("time_limit_s", time_limit_s, {1, 100'000}, "Simulated time after which a flight is ended.");
  fields("visual_odometry_alone", visual_odometry_alone,
         "Track the RGB-D camera without any other sensor beside the flight, and score its trajectory, too.");
  fields("clearance_m", clearance_m, {0, 5},
         "The mission's distance between hull and obstacle; where it does not fit is not reachable.");
  fields("reachable_area_max_m2", reachable_area_max_m2, {1, 20'000},
         "A world in which the vehicle can reach more is taken for open: no coverage is measured.");
  fields.section("criteria", criteria, "What each flight, and all of them together, must reach to pass.");
  fields.list("paper", paper, "Figures of the paper that is flown again.");
  fields.section("map", map, "Map that the flights are given to find themselves in; without one they make their own.");
  fields.list("operator", operator_steps, "An operator who follows a script; its commands come one after the other.");
  fields.list("phases", phases, "Parts of the flight that have figures of their own, and criteria on them.");
  fields.list("event_orders", event_orders, "Events that must come in an order, with the vehicle where they must.");
  fields.list("asked_of", asked_of, "What is asked of one of the systems beyond what is asked of all.");
  fields.list("targets", targets, "Models of the world that the flight is to find, or to recognize.");
  fields.section("scenario", scenario, "World, start, weather, people, faults, and what the seed varies.");
}

std::vector<common::Problem> TrialConfig::validate() const {
  common::Validation validation;
  for (const SystemBounds& one : asked_of) checkBounds(*this, one, validation);
  checkVehicles(*this, validation);
  checkPhases(phases, validation);
  const Message empty_name("config.empty-name", "has an empty name");
  return validation
      .require(name.find('/') == std::string::npos, "name",
               Message("trial.name-of-path", "holds a `/`, but names folders"))
      .require(canBeSeen(name), "name",
               Message("trial.name-not-seen", "is longer than 100 characters or holds some that cannot be seen"))
      .given(!mission.empty(), "mission")
      .given(!system.empty(), "system")
      .require(!hasEmpty(systems), "systems", empty_name)
      .require(!natures.empty(), "natures", Message("config.empty", "is empty"))
      .require(!hasEmpty(natures), "natures", empty_name)
      .require(!each_fault || !scenario.faults.empty(), "each_fault",
               Message("trial.no-faults", "is set, but the scenario has no faults"))
      .require(!scenario.world.empty(), "scenario", Message("trial.no-world", "names no `world`"))
      .problems();
}

std::vector<TrialConfig> TrialConfig::byCondition() const {
  std::vector<TrialConfig> trials;
  for (const TrialConfig& with_system : bySystem())
    for (const TrialConfig& in_nature : with_system.byNature())
      for (const TrialConfig& with_charge : in_nature.byCharge())
        for (TrialConfig& with_fault : with_charge.byFault()) trials.push_back(std::move(with_fault));
  return trials;
}

bool TrialConfig::flies(const std::string& profile) const {
  return systems.empty() ? profile == system : std::find(systems.begin(), systems.end(), profile) != systems.end();
}

std::vector<PhaseBound> TrialConfig::figureBounds() const {
  std::vector<PhaseBound> bounds;
  for (const SystemBounds& one : asked_of)
    if (one.system == system) bounds.insert(bounds.end(), one.figures.begin(), one.figures.end());
  return bounds;
}

std::vector<TrialConfig> TrialConfig::bySystem() const {
  std::vector<TrialConfig> trials;
  for (const std::string& one : systems.empty() ? std::vector<std::string>{system} : systems) {
    trials.push_back(*this);
    trials.back().system = one;
    for (const SystemBounds& bounds : asked_of)
      if (bounds.system == one) trials.back().phases = bounded(trials.back().phases, bounds.phases);
    trials.back().systems.clear();
    if (systems.size() > 1) trials.back().name += "-" + fs::path(one).stem().string();
  }
  return trials;
}

std::vector<TrialConfig> TrialConfig::byNature() const {
  std::vector<TrialConfig> trials;
  for (const std::string& nature : natures) {
    trials.push_back(*this);
    trials.back().natures = {nature};
    if (natures.size() > 1) trials.back().name += "-" + fs::path(nature).stem().string();
  }
  return trials;
}

std::vector<TrialConfig> TrialConfig::byCharge() const {
  if (batteries.empty()) return {*this};
  std::vector<TrialConfig> trials;
  for (const double remaining : batteries) {
    trials.push_back(*this);
    trials.back().batteries = {remaining};
    trials.back().scenario.setCharge(remaining);
    if (batteries.size() > 1) trials.back().name += fmt::format("-charge{:g}", 100.0 * remaining);
  }
  return trials;
}

std::vector<TrialConfig> TrialConfig::byFault() const {
  if (!each_fault) return {*this};
  std::vector<TrialConfig> trials;
  std::map<std::string, int> named;
  for (const simulation::FaultConfig& fault : scenario.faults) {
    trials.push_back(*this);
    trials.back().scenario.faults = {fault};
    if (scenario.faults.size() == 1) continue;
    const std::string what = nameOf(fault);
    const int number = ++named[what];
    trials.back().name += "-" + what + (number > 1 ? fmt::format("-{}", number) : "");
  }
  return trials;
}

void TrialConfig::resolvePaths(const fs::path& unpacked, const fs::path& root) {
  const auto resolve = [&](std::string& path) {
    path = ((fs::exists(unpacked / path) ? unpacked : root) / path).lexically_normal().string();
  };
  resolve(scenario.world);
  for (std::string& path : scenario.model_paths) resolve(path);
}

void TrialConfig::setSystem(const std::string& profile) {
  systems = {profile};
  places.erase("system");
  places.erase("systems");
}

common::SourceLocation TrialConfig::placeOf(const std::string& key) const {
  const auto place = places.find(key);
  return place == places.end() ? common::SourceLocation{} : place->second;
}

TrialConfig readTrial(const fs::path& file) {
  TrialConfig trial;
  auto reader = common::config::YamlReader::fromFile(file.string());
  reader.read(trial);
  constexpr std::string_view kScenario = "scenario.";
  for (const std::string& key : reader.writtenKeys()) {
    if (key.starts_with(kScenario)) trial.scenario.written.push_back(key.substr(kScenario.size()));
    trial.places[key] = reader.locationOf(key);
  }
  for (std::size_t i = 0; i < trial.operator_steps.size(); ++i)
    trial.operator_steps[i].place = reader.locationOf(fmt::format("operator[{}].command", i));
  if (trial.name.empty()) trial.name = file.stem().string();
  trial.folder = file.parent_path();
  return trial;
}

std::vector<TrialConfig> readTrials(const fs::path& file_or_folder) {
  std::error_code failure;
  if (!fs::is_directory(file_or_folder, failure)) return {readTrial(file_or_folder)};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(file_or_folder))
    if (entry.is_regular_file() && isTrialFile(entry.path())) files.push_back(entry.path());
  if (files.empty())
    throw InputError({file_or_folder.string()}, "", Message("trial.none", "holds no trials"),
                     "expected are files NAME.yaml");
  std::sort(files.begin(), files.end());

  std::vector<TrialConfig> trials;
  std::vector<Problem> problems;
  std::map<std::string, fs::path> named;
  for (const fs::path& file : files) {
    try {
      trials.push_back(readTrial(file));
      const auto [other, isNew] = named.emplace(trials.back().name, file);
      if (!isNew)
        problems.push_back(
            {{file.string()},
             "name",
             Message("trial.name-twice", "`{}` is the name of {} too", trials.back().name, other->second.string()),
             "their flights would lie in the same folders"});
    } catch (const InputError& e) {
      problems.insert(problems.end(), e.problems().begin(), e.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return trials;
}

fs::path dataSetsFolder(const fs::path& root) {
  const char* variable = std::getenv("SWIFTLET_DATASETS");
  return variable != nullptr && *variable != '\0' ? fs::path(variable) : root / "../shared/datasets";
}

fs::path findArchive(const std::string& archive, const fs::path& data_sets) {
  fs::path file = data_sets / archive;
  if (fs::is_regular_file(file)) return file;
  throw InputError({file.string()}, "archive", Message("trial.no-archive", "there is no such file"),
                   "set SWIFTLET_DATASETS to the folder that holds `" + archive + "`");
}

}  // namespace swiftlet::evaluation
