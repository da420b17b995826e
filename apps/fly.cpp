// swiftlet fly: one mission in the simulator, with the page.
#include <memory>
#include <optional>

#include <fmt/color.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/flight.hpp"
#include "apps/mission_limits.hpp"
#include "apps/progress_line.hpp"
#include "apps/show.hpp"
#include "apps/speed.hpp"
#include "apps/stop_signals.hpp"
#include "apps/web_link.hpp"
#include "common/data_paths.hpp"
#include "common/printable.hpp"
#include "common/rounding.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::apps {
namespace {

struct FlyOptions {
  std::string mission;
  std::string world = "worlds/unb_case1.sdf";
  std::string map;
  std::string system = "swiftlet";
  int seed = 1;
  std::string speed;
  bool headless = false;
  std::string listen = "127.0.0.1";
  int port = 8080;
  std::string out;
  double time_limit_s = 1800.0;
  bool json = false;
};

FlightSetup setupOf(const FlyOptions& options) {
  FlightSetup setup;
  setup.system = loadSystem(options.system);
  setup.mission_file = common::findData(options.mission).string();
  setup.scenario.seed = options.seed;
  setup.scenario.world = common::findData(options.world).string();
  setup.started = startedNow();
  setup.speed = parseSpeed(options.speed.empty() ? (options.headless ? "max" : "1") : options.speed);
  setup.time_limit_s = options.time_limit_s;
  setup.linger_s = options.headless ? 0.0 : 2.0;
  setup.out = options.out;
  return setup;
}

std::string progressLine(const FlightProgress& progress) {
  const common::World& world = *progress.world;
  const common::VehicleLayer& vehicle = *world.vehicle;
  const std::string& phase = world.mission->status.phase;
  const double explored_m2 = world.map->explored_area_m2;
  const std::string explored = explored_m2 > 0 ? fmt::format("{:6.1f} m2", explored_m2) : std::string(9, ' ');
  return fmt::format("{:6.1f} s  {:<24.24} {}  {:6.1f} m  battery {:3.0f} %  {:5.1f} x real time", progress.simulated_s,
                     phase.empty() ? toString(vehicle.flight_state) : phase, explored, vehicle.distance_flown_m,
                     100.0 * world.energy->battery_remaining,
                     progress.wall_s > 0 ? progress.simulated_s / progress.wall_s : 0.0);
}

class Terminal {
 public:
  explicit Terminal(bool quiet) : quiet_(quiet), line_(quiet) {}

  void progress(const FlightProgress& progress) { line_.update(progressLine(progress), progress.wall_s); }

  void event(const common::Event& event) {
    if (quiet_) return;
    line_.close();
    const std::string text = fmt::format("{:6.1f} s  {}: {}{}", event.stamp.seconds(), event.source, event.text,
                                         event.reason.empty() ? "" : " (" + event.reason + ")");
    if (line_.interactive() && event.severity != common::Severity::kInfo) {
      showStyled(fmt::format(fg(event.severity == common::Severity::kError ? fmt::color::red : fmt::color::orange),
                             "{}\n", common::printable(text)));
    } else {
      show(text + "\n");
    }
  }

  void closeLine() { line_.close(); }

 private:
  bool quiet_;
  ProgressLine line_;
};

void printEnd(const FlightResult& result, bool json) {
  const interfaces::FlightSummary& summary = result.summary;
  const std::optional<double>& explored_m2 = summary.explored_area_m2;
  if (json) {
    showJson(nlohmann::json{
                 {"outcome", toString(summary.outcome)},
                 {"reason", summary.reason},
                 {"mission_time_s", common::rounded(summary.mission_time.seconds())},
                 {"distance_m", common::rounded(summary.distance_m)},
                 {"explored_area_m2", explored_m2 ? nlohmann::json(common::rounded(*explored_m2)) : nlohmann::json()},
                 {"realtime_factor", common::rounded(summary.realtime_factor.value_or(0.0))},
                 {"run", result.folder.string()},
                 {"report", (result.folder / "report.html").string()}}
                 .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
             "\n");
    return;
  }
  show(fmt::format("\n{}{} after {:.1f} s and {:.1f} m{}, {:.1f} x real time\n", toString(summary.outcome),
                   summary.reason.empty() ? "" : " (" + summary.reason + ")", summary.mission_time.seconds(),
                   summary.distance_m, explored_m2 ? fmt::format(", {:.1f} m2 explored", *explored_m2) : "",
                   summary.realtime_factor.value_or(0.0)));
  show(fmt::format("run     {}\nreport  {}\n", result.folder.string(), (result.folder / "report.html").string()));
}

int fly(const FlyOptions& options) {
  FlightSetup setup = setupOf(options);
  behaviors::Mission mission = soundMission(setup.mission_file, setup.system, !options.map.empty());
  if (!options.map.empty()) setup.map = std::make_shared<const FlightMap>(readFlightMap(options.map));
  const std::atomic<bool>& stop = stopOnSignals();
  outliveReaders();

  std::unique_ptr<WebLink> web;
  if (!options.headless) {
    const auto title = fmt::format("{} in {}", std::filesystem::path(options.mission).stem().string(),
                                   std::filesystem::path(options.world).stem().string());
    web = std::make_unique<WebLink>(options.listen, options.port, title, setup.system.vehicle.hull_diameter_m);
    const std::string page = fmt::format("page    {}\n\n", web->operatorUrl());
    if (options.json)
      showError(page);  // The token is in it, and standard output is the outcome alone.
    else
      show(page);
  }
  Terminal terminal(options.json);
  FlightHooks hooks;
  hooks.progress = [&](const FlightProgress& progress) { terminal.progress(progress); };
  hooks.event = [&](const common::Event& event) { terminal.event(event); };
  hooks.web = web.get();
  hooks.stop = &stop;

  const FlightResult result = flySimulated(setup, std::move(mission), hooks);
  terminal.closeLine();
  printEnd(result, options.json);
  if (result.write_failure) {
    showError(*result.write_failure + "\n");
    return kBadInput;
  }
  return result.summary.outcome == interfaces::Outcome::kDone ? kDone : kFailed;
}

}  // namespace

void addFly(Command& program) {
  auto options = std::make_shared<FlyOptions>();
  Command command = program.command("fly", "Fly a mission in the simulator; the page shows it live.");
  command.argument("mission", options->mission, "Mission file (XML).");
  command.option("--world", options->world, "World to fly in (SDF).");
  command.option("--map", options->map,
                 "A map of the place (YAML of map_server): the flight finds out where it is in it.");
  command.option("--system", options->system, "A profile of config/systems, or a file.");
  command.option("--seed", options->seed, {0, kGreatestSeed}, "Seed of all random numbers.");
  command.option("--speed", options->speed, "Times real time, or max. Default: 1, headless max.");
  command.flag("--headless", options->headless, "Without the page.");
  command.option("--listen", options->listen, "Address the page listens on; 0.0.0.0: of every network.");
  command.option("--port", options->port, {0, 65535}, "Port of the page, 0 for any.");
  command.option("--out", options->out, "Folder of the run; default runs/<time>-<mission>.");
  command.option("--time-limit", options->time_limit_s, {0.01, 1e6},
                 "Simulated seconds after which the flight is stopped.");
  command.flag("--json", options->json, "Print the outcome as JSON, nothing else.");
  command.footer("Example: swiftlet fly missions/explore_and_return.xml --world worlds/unb_case1.sdf --seed 7");
  command.runs([options] { return fly(*options); });
}

}  // namespace swiftlet::apps
