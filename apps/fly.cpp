// swiftlet fly: one mission in the simulator, with the page.
#include <memory>
#include <optional>

#include <fmt/color.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/progress_line.hpp"
#include "apps/show.hpp"
#include "apps/speed.hpp"
#include "apps/start_option.hpp"
#include "behaviors/mission_check.hpp"
#include "common/data_paths.hpp"
#include "common/printable.hpp"
#include "common/rounding.hpp"
#include "common/topological_map.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "evaluation/trial.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/groot_link.hpp"
#include "flight/leaf_libraries.hpp"
#include "flight/mission_limits.hpp"
#include "flight/stop_signals.hpp"
#include "flight/web_link.hpp"
#include "simulated_flight/flight.hpp"
#include "simulated_flight/trial_files.hpp"
#include "simulated_flight/trial_world.hpp"
#include "simulation/nature.hpp"
#include "web/server/public_url.hpp"

namespace swiftlet::apps {
namespace {

const std::string kWorld = "worlds/unb_case1.sdf";

struct FlyOptions {
  std::string mission;
  std::vector<std::string> leaves;
  std::string world;
  std::vector<std::string> model_paths;
  bool allow_incomplete_world = false;
  std::string start;  ///< Empty: the scenario's, or that of the world.
  std::string scenario;
  std::string map;
  std::string places;
  std::string system;  ///< Empty: the first of the scenario's trial, or swiftlet.
  std::string nature;  ///< Empty: the first of the scenario, or real.
  std::optional<double> battery;
  std::optional<int> seed;
  std::string vehicle_memory;
  bool control_log = false;
  bool record_rgbd = false;
  std::string speed;
  bool headless = false;
  bool wait = false;
  std::string listen = "127.0.0.1";
  int port = 8080;
  std::vector<std::string> public_urls;
  std::optional<int> groot;
  std::string out;
  double time_limit_s = 1800.0;
  bool json = false;
};

void takeWorldOptions(const FlyOptions& options, simulation::Scenario& scenario) {
  std::vector<std::string> folders;
  for (const std::string& folder : options.model_paths)
    folders.push_back(simulated_flight::findModelFolder(folder, "--model-path"));
  scenario.model_paths.insert(scenario.model_paths.begin(), folders.begin(), folders.end());
  scenario.allow_incomplete_world = scenario.allow_incomplete_world || options.allow_incomplete_world;
  if (options.start.empty()) return;
  if (!scenario.vehicles.empty())
    throw common::InputError({}, "--start",
                             common::Message("fly.several-vehicles", "the scenario has several vehicles"),
                             "say in its file where each of them starts");
  scenario.start = parseStart(options.start);
}

/// Of several systems, natures and batteries the first counts.
evaluation::TrialConfig conditionsOf(const FlyOptions& options) {
  evaluation::TrialConfig trial;
  if (!options.scenario.empty() && !options.world.empty())
    throw common::InputError({}, "--scenario", common::Message("fly.two-worlds", "the scenario says which world"),
                             "leave out --world");
  if (options.scenario.empty()) {
    trial.scenario.world = simulated_flight::findWorldFile(options.world.empty() ? kWorld : options.world).string();
  } else {
    trial = evaluation::readTrial(flight::findTrial(options.scenario));
    simulated_flight::findWorld(trial);
  }
  if (!options.system.empty())
    trial.system = options.system;
  else if (!trial.systems.empty())
    trial.system = trial.systems.front();
  if (options.system.empty())
    if (auto missing = simulated_flight::findSystemOf(trial)) throw common::InputError(*std::move(missing));
  if (!options.nature.empty()) trial.natures = {options.nature};
  takeWorldOptions(options, trial.scenario);
  return trial;
}

simulated_flight::SimulatedSetup setupOf(const FlyOptions& options) {
  for (const std::string& url : options.public_urls) (void)web::parsePublicUrl(url);
  simulated_flight::SimulatedSetup setup;
  setup.types = flight::nodesWith(options.leaves);
  setup.mission_file = flight::findMission(options.mission);
  const evaluation::TrialConfig trial = conditionsOf(options);
  setup.system = flight::loadSystem(trial.system);
  setup.scenario = trial.scenario;
  if (options.seed) setup.scenario.seed = *options.seed;
  // A battery is charged before a flight, unless the scenario or the option says otherwise.
  setup.scenario.nature =
      std::make_shared<const simulation::Nature>(simulation::Nature::load(trial.natures.front()).withCharge(0.9, 1.0));
  if (!trial.batteries.empty()) setup.scenario.setCharge(trial.batteries.front());
  if (options.battery) setup.scenario.setCharge(*options.battery);
  if (!options.vehicle_memory.empty())
    setup.memory = flight::setupOfMemory(options.vehicle_memory, setup.system.vehicle, setup.scenario.vehicles.size(),
                                         flight::MemoryUse::kReadAndWrite);
  setup.control_log = options.control_log;
  setup.record_rgbd = options.record_rgbd;
  setup.speed = parseSpeed(options.speed.empty() ? (options.headless ? "max" : "1") : options.speed);
  setup.time_limit_s = options.time_limit_s;
  setup.out = options.out;
  setup.wait = options.wait;
  if (options.wait && options.headless)
    throw common::InputError({}, "--wait",
                             common::Message("fly.nobody-starts", "without the page nobody can start the mission"),
                             "leave out --headless");
  return setup;
}

std::string phaseOf(const common::World& world) {
  const std::string& phase = world.mission->status.phase;
  return phase.empty() ? toString(world.vehicle->flight_state) : phase;
}

std::string oneVehicle(const common::World& world) {
  const double explored_m2 = world.map->explored_area_m2;
  const std::string explored = explored_m2 > 0 ? fmt::format("{:6.1f} m2", explored_m2) : std::string(9, ' ');
  return fmt::format("{:<24.24} {}  {:6.1f} m  battery {:3.0f} %", phaseOf(world), explored,
                     world.vehicle->distance_flown_m, 100.0 * world.energy->battery_remaining);
}

std::string oneOfSeveral(const common::World& world) {
  return fmt::format("{}: {:<20.20} {:5.1f} m  {:3.0f} %", world.vehicle->name, phaseOf(world),
                     world.vehicle->distance_flown_m, 100.0 * world.energy->battery_remaining);
}

std::string progressLine(const simulated_flight::FlightProgress& progress) {
  std::string vehicles;
  for (const auto& world : progress.worlds)
    vehicles += progress.worlds.size() == 1 ? oneVehicle(*world) + "  " : oneOfSeveral(*world) + "  ";
  return fmt::format("{:6.1f} s  {}{:5.1f} x real time", progress.simulated_s, vehicles,
                     progress.wall_s > 0 ? progress.simulated_s / progress.wall_s : 0.0);
}

class Terminal {
 public:
  explicit Terminal(bool quiet) : quiet_(quiet), line_(quiet) {}

  void progress(const simulated_flight::FlightProgress& progress) {
    line_.update(progressLine(progress), progress.wall_s);
  }

  void event(const common::Event& event) {
    if (quiet_) return;
    line_.close();
    const bool alarm = !common::alarmOf(event).empty();
    const std::string text = fmt::format(
        "{:6.1f} s  {}{}{}: {}{}", event.stamp.seconds(), event.vehicle.empty() ? "" : event.vehicle + " ",
        alarm ? "ALARM " : "", event.source, event.text, event.reason.empty() ? "" : " (" + event.reason + ")");
    if (line_.interactive() && event.severity != common::Severity::kInfo) {
      const bool red = alarm || event.severity == common::Severity::kError;
      showStyled(fmt::format(fg(red ? fmt::color::red : fmt::color::orange), "{}\n", common::printable(text)));
    } else {
      show(text + "\n");
    }
  }

  void closeLine() { line_.close(); }

 private:
  bool quiet_;
  ProgressLine line_;
};

nlohmann::json endJson(const flight::VehicleResult& vehicle) {
  const interfaces::FlightSummary& summary = vehicle.summary;
  const std::optional<double>& explored_m2 = summary.explored_area_m2;
  nlohmann::json json = {
      {"outcome", toString(summary.outcome)},
      {"reason", summary.reason},
      {"mission_time_s", common::rounded(summary.mission_time.seconds())},
      {"distance_m", common::rounded(summary.distance_m)},
      {"explored_area_m2", explored_m2 ? nlohmann::json(common::rounded(*explored_m2)) : nlohmann::json()},
      {"realtime_factor", common::rounded(summary.realtime_factor.value_or(0.0))},
      {"run", vehicle.folder.string()},
      {"report", (vehicle.folder / "report.html").string()}};
  if (!vehicle.name.empty()) json["vehicle"] = vehicle.name;
  return json;
}

/// Of several vehicles: the list, and whether all are done.
nlohmann::json endJson(const simulated_flight::FlightResult& result) {
  if (result.vehicles.size() == 1) return endJson(result.vehicles.front());
  nlohmann::json vehicles = nlohmann::json::array();
  for (const flight::VehicleResult& vehicle : result.vehicles) vehicles.push_back(endJson(vehicle));
  return {{"outcome", result.done() ? "done" : "failed"}, {"run", result.folder.string()}, {"vehicles", vehicles}};
}

/// "window 1 open at (2.00, 0.10, 1.30), red 1 at ...": what was found and recognized; empty without any.
std::string recognizedText(const interfaces::FlightSummary& summary) {
  std::vector<std::string> found;
  const auto at = [](const Eigen::Vector3d& p) {
    return fmt::format(" at ({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z());
  };
  for (const common::Target& target : summary.targets)
    if (target.state == common::TargetState::kFound) found.push_back(labelOf(target) + at(target.position_map_m));
  for (const common::RecognizedObject& object : summary.objects)
    if (object.confirmed)
      found.push_back(labelOf(object) +
                      (object.passage == common::Passage::kNone ? "" : std::string(" ") + toString(object.passage)) +
                      at(object.T_map_object.position_m));
  return fmt::format("{}", fmt::join(found, ", "));
}

void printEnd(const flight::VehicleResult& vehicle) {
  const interfaces::FlightSummary& summary = vehicle.summary;
  const std::optional<double>& explored_m2 = summary.explored_area_m2;
  show(fmt::format("\n{}{}{} after {:.1f} s and {:.1f} m{}, {:.1f} x real time\n",
                   vehicle.name.empty() ? "" : vehicle.name + ": ", toString(summary.outcome),
                   summary.reason.empty() ? "" : " (" + summary.reason + ")", summary.mission_time.seconds(),
                   summary.distance_m, explored_m2 ? fmt::format(", {:.1f} m2 explored", *explored_m2) : "",
                   summary.realtime_factor.value_or(0.0)));
  if (const std::string found = recognizedText(summary); !found.empty()) show("found   " + found + "\n");
  show(fmt::format("run     {}\nreport  {}\n", vehicle.folder.string(), (vehicle.folder / "report.html").string()));
}

void printEnd(const simulated_flight::FlightResult& result, bool json) {
  if (json) return showJson(endJson(result).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  for (const flight::VehicleResult& vehicle : result.vehicles) printEnd(vehicle);
}

std::shared_ptr<const common::TopologicalMap> givenPlacesOf(const FlyOptions& options) {
  if (options.places.empty()) return nullptr;
  auto places = std::make_shared<const common::TopologicalMap>(
      common::readTopologicalMap(common::findData(options.places).string()));
  if (places->frame == common::PlacesFrame::kGiven && options.map.empty())
    throw common::InputError({options.places}, "frame",
                             common::Message("places.no-map", "they are those of a given map, and the flight has none"),
                             "give it that map: --map MAP.yaml");
  return places;
}

/// What `check` warns of does not keep the vehicle on the ground.
void showWarnings(const std::vector<flight::FlightMission>& missions, const flight::FlightSetup& setup, bool headless) {
  behaviors::MissionLimits limits;
  limits.unseen_below_m = flight::unseenBelow_m(setup.system);
  limits.places = setup.places;
  limits.operator_goes_on = limits.operator_gives_goals = !headless;
  for (const flight::FlightMission& mission : missions) {
    for (const tree::Problem& warning : behaviors::judgeMission(mission.file, limits, *setup.types).warnings)
      showError(lineOf(warning, true));
    showNotes(flight::mapNotes(mission.mission.mapFiles(), mission.file));
  }
}

std::unique_ptr<flight::WebLink> servePage(const FlyOptions& options, const simulated_flight::SimulatedSetup& setup) {
  web::WebServerOptions page;
  page.address = options.listen;
  page.port = options.port;
  page.public_urls = options.public_urls;
  page.title = fmt::format("{} in {}", std::filesystem::path(options.mission).stem().string(),
                           std::filesystem::path(setup.scenario.world).stem().string());
  return flight::servePage(std::move(page), setup, static_cast<std::uint64_t>(setup.scenario.seed),
                           simulated_flight::vehicleNames(setup.scenario));
}

int fly(const FlyOptions& options) {
  simulated_flight::SimulatedSetup setup = setupOf(options);
  setup.places = givenPlacesOf(options);
  std::vector<flight::FlightMission> missions = simulated_flight::soundMissions(setup, !options.map.empty());
  showWarnings(missions, setup, options.headless);
  if (!options.map.empty()) {
    setup.map = std::make_shared<const flight::FlightMap>(flight::readFlightMap(options.map));
    showNotes(setup.map->notes);
  }
  const flight::StopSignals& signals = flight::stopOnSignals();
  outliveReaders();

  std::unique_ptr<flight::WebLink> web;
  if (!options.headless) {
    web = servePage(options, setup);
    std::string pages;
    for (const std::string& url : web->operatorUrls()) pages += fmt::format("page    {}\n", url);
    if (options.json)
      showError(pages + "\n");  // The token is in it, and standard output is the outcome alone.
    else
      show(pages + "\n");
  }
  std::unique_ptr<flight::GrootLink> groot;
  if (options.groot) {
    groot = std::make_unique<flight::GrootLink>(options.listen, *options.groot, *setup.types);
    const std::string line = fmt::format("groot   {}:{}\n", options.listen, groot->port());
    if (options.json)
      showError(line);
    else
      show(line);
  }
  Terminal terminal(options.json);
  simulated_flight::SimulatedHooks hooks;
  hooks.progress = [&](const simulated_flight::FlightProgress& progress) { terminal.progress(progress); };
  hooks.event = [&](const common::Event& event) { terminal.event(event); };
  hooks.web = web.get();
  hooks.groot = groot.get();
  hooks.land = &signals.first;
  hooks.stop = &signals.second;

  const simulated_flight::FlightResult result = simulated_flight::flySimulated(setup, std::move(missions), hooks);
  terminal.closeLine();
  printEnd(result, options.json);
  if (const auto failure = result.writeFailure()) {
    showError(*failure + "\n");
    return kBadInput;
  }
  return result.done() ? kDone : kFailed;
}

}  // namespace

void addFly(Command& program) {
  auto options = std::make_shared<FlyOptions>();
  Command command = program.command("fly", "Fly a mission in the simulator; the page shows it live.");
  command.argument("mission", options->mission, "Mission file (XML).");
  command.leavesOption(options->leaves);
  command.option("--world", options->world, fmt::format("World to fly in (SDF). Default: {}.", kWorld));
  command.option("--model-path", options->model_paths,
                 "Folder that holds models which the world includes; may be given several times.");
  command.flag("--allow-incomplete-world", options->allow_incomplete_world,
               "Fly though models, meshes or collisions of the world are missing: the vehicle meets nothing there.");
  command.option("--start", options->start,
                 "Where the vehicle stands in the world: \"x;y;yaw\" in metres and degrees, or \"x;y;z;yaw\". Default: "
                 "the scenario's, or the world's frame `start`, or its origin.");
  command.option("--scenario", options->scenario,
                 "A trial file whose scenario is flown: world, start, people, weather, several vehicles; with its "
                 "profile, nature and charge.");
  command.option("--map", options->map,
                 "A map of the place (YAML of map_server): the flight finds out where it is in it.");
  command.option(
      "--places", options->places,
      "A topological map (topological_map.yaml of a run), whose places, passages and danger zones the mission "
      "may name: goal=\"{kitchen}\".");
  command.option("--system", options->system,
                 "A profile of config/systems, or a file. Default: the scenario's, or swiftlet.");
  command.option(
      "--nature", options->nature,
      "How far the vehicle is from its data sheet: calm, real, harsh, or a file. Default: the scenario's, or real.");
  command.option("--battery", options->battery, {0.01, 1},
                 "Charge at the start, as a share of the full one. Default: the scenario's, or that of the nature.");
  command.option("--vehicle-memory", options->vehicle_memory,
                 "File with what earlier flights learned of the vehicle: read at the start, written at the end.");
  command.flag("--control-log", options->control_log,
               "Keep commands, motion and battery at 100 Hz in the run: what `identify` reads.");
  command.flag("--record-rgbd", options->record_rgbd,
               "Keep the frames of the RGB-D camera in the run, as a folder that `map3d` reads.");
  command.option("--seed", options->seed, {0, simulation::kGreatestSeed},
                 "Seed of all random numbers. Default: the scenario's, or 1.");
  command.option("--speed", options->speed, "Times real time, or max. Default: 1, headless max.");
  command.flag("--headless", options->headless, "Without the page.");
  command.flag("--wait", options->wait,
               "Stay on the ground until a mission is started on the page: this one, or another.");
  command.option("--listen", options->listen, "Address the page listens on; 0.0.0.0: of every network.");
  command.option("--port", options->port, {0, 65535}, "Port of the page, 0 for any.");
  command.option(
      "--public-url", options->public_urls,
      "An address by which others open the page: of a proxy in front of it (https://field.example/swiftlet/), "
      "or with a name of this machine (http://drone.local:8080/). May be given several times.");
  command.option(
      "--groot", options->groot, {0, 65535},
      "Let Groot2 watch the mission's tree at this port (1667 is its own; 0: any), on the address of --listen.");
  command.option("--out", options->out, "Folder of the run; default runs/<time>-<mission>.");
  command.option("--time-limit", options->time_limit_s, {0.01, 1e6},
                 "Simulated seconds after which the flight is stopped.");
  command.flag("--json", options->json, "Print the outcome as JSON, nothing else.");
  command.footer("Example: swiftlet fly missions/explore_and_return.xml --world worlds/unb_case1.sdf --seed 7");
  command.runs([options] { return fly(*options); });
}

}  // namespace swiftlet::apps
