// swiftlet map: the map of a recorded laser log.
#include <chrono>
#include <memory>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/map_folder.hpp"
#include "apps/map_outputs.hpp"
#include "apps/progress_line.hpp"
#include "apps/show.hpp"
#include "apps/system.hpp"
#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct MapOptions {
  std::string log;
  std::string sensor;
  std::string odometry = "auto";
  std::string slam = "graph";
  std::string out;
  bool json = false;
};

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// "logs/intel.clf.bz2" -> "intel-map".
fs::path folderFor(const MapOptions& options) {
  if (!options.out.empty()) return options.out;
  const std::string name = fs::path(options.log).filename().string();
  return name.substr(0, name.find('.')) + "-map";
}

perception::LaserSlamConfig configOf(const MapOptions& options) {
  perception::LaserSlamConfig config;
  if (options.slam == "particles") config.method = perception::SlamMethod::kParticles;
  return config;
}

struct MapRun {
  explicit MapRun(const MapOptions& options) : slam(configOf(options)) {}

  perception::LaserSlam slam;
  TrackSpool track;
  ThinnedCurve milliseconds;
  std::uint64_t scans = 0, unmatched = 0;
  double wall_s = 0.0;
  std::string damage;  ///< Why the log could not be read to its end.
};

/// None at the end, also at one that a damage makes: what came before it is mapped all the same.
std::optional<interfaces::LoggedScan> nextOf(interfaces::LaserLog& log, MapRun& run) {
  try {
    return log.next();
  } catch (const common::InputError& e) {
    if (run.scans == 0) throw;
    run.damage = e.what();
    return std::nullopt;
  }
}

void mapLog(interfaces::LaserLog& log, const MapOptions& options, MapRun& run) {
  const auto begin = Clock::now();
  ProgressLine line(options.json);
  while (const auto logged = nextOf(log, run)) {
    perception::LaserSlamInput input{logged->scan, logged->T_robot_laser, logged->T_odom_robot};
    if (options.odometry == "none") input.T_odom_robot.reset();
    const auto scan_begin = Clock::now();
    const auto tracked = run.slam.add(input);
    run.milliseconds.add(static_cast<double>(run.scans), 1e3 * secondsSince(scan_begin));
    ++run.scans;
    if (!tracked) continue;
    run.unmatched += tracked->matched ? 0 : 1;
    run.track.add(logged->scan.stamps.measured, *tracked);
    if (run.scans % 50 == 0)
      line.update(fmt::format("{:3.0f} %  {} scans, {} key scans, {} loops", 100.0 * log.progress(), run.scans,
                              run.slam.keyScans(), run.slam.slam().counts().loops_closed),
                  secondsSince(begin));
  }
  run.slam.finish();
  run.wall_s = secondsSince(begin);
  line.close();
}

std::string plural(std::uint64_t count, const std::string& one, const std::string& more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

std::vector<std::string> warningsOf(const interfaces::LaserLog& log, const MapRun& run) {
  std::vector<std::string> warnings = log.notes();
  if (!run.damage.empty()) warnings.push_back("the map is of what came before: " + run.damage);
  if (const auto n = log.counts().skipped_records; n > 0) {
    warnings.push_back(plural(n, "record could not be read and was", "records could not be read and were") +
                       " skipped");
    for (const common::Problem& problem : log.counts().first_problems) warnings.push_back(toString(problem));
  }
  if (const auto n = log.counts().invalid_ranges; n > 0)
    warnings.push_back(plural(n, "range is", "ranges are") + " negative or not a number");
  if (const auto n = run.slam.counts().doubtful_stamps; n > 0)
    warnings.push_back(plural(n, "time stamp does", "time stamps do") +
                       " not come after the one before: the order of the file is believed, not the intervals");
  if (const auto n = run.slam.counts().doubtful_odometry; n > 0)
    warnings.push_back(plural(n, "step", "steps") + " of the odometry no robot makes; not believed");
  if (const auto n = run.slam.odometryCounts().restarts; n > 0)
    warnings.push_back("the track was lost " + plural(n, "time", "times") + " and begun anew where it was expected");
  return warnings;
}

nlohmann::ordered_json figuresOf(const MapOptions& options, const interfaces::LaserLog& log, const MapRun& run,
                                 const fs::path& out) {
  const perception::SlamCounts& slam = run.slam.slam().counts();
  return {{"log", options.log},
          {"format", log.format()},
          {"out", out.string()},
          {"complete", run.damage.empty()},
          {"scans", run.scans},
          {"skipped_records", log.counts().skipped_records},
          {"invalid_ranges", log.counts().invalid_ranges},
          {"doubtful_stamps", run.slam.counts().doubtful_stamps},
          {"doubtful_odometry_steps", run.slam.counts().doubtful_odometry},
          {"unmatched_scans", run.unmatched},
          {"restarts", run.slam.odometryCounts().restarts},
          {"key_scans", run.slam.keyScans()},
          {"loops_closed", slam.loops_closed},
          {"seconds", run.wall_s},
          {"scans_per_s", static_cast<double>(run.scans) / run.wall_s},
          {"notes", warningsOf(log, run)}};
}

int map(const MapOptions& options) {
  interfaces::LaserLogOptions log_options;
  if (!options.sensor.empty()) log_options.sensor = loadLaser(options.sensor);
  const auto log = interfaces::openLaserLog(options.log, log_options);
  const MapFolder folder(folderFor(options));
  const fs::path& out = folder.path();
  MapRun run(options);
  mapLog(*log, options, run);
  if (run.slam.keyPoses().empty())
    throw common::InputError(common::Problem{{options.log},
                                             "",
                                             fmt::format("no map: none of its {} scans has points enough", run.scans),
                                             log->counts().first_problems.empty()
                                                 ? ""
                                                 : "first problem: " + toString(log->counts().first_problems.front())});

  if (!run.damage.empty()) fmt::print(stderr, "{}\n", run.damage);
  const nlohmann::ordered_json figures = figuresOf(options, *log, run, out);
  MapFigures shown{options.log, {}, warningsOf(*log, run), run.milliseconds};
  const perception::SlamCounts& slam = run.slam.slam().counts();
  shown.facts = {{"log", log->format()},
                 {"scans", fmt::format("{}", run.scans)},
                 {"not matched", fmt::format("{}", run.unmatched)},
                 {"key scans", fmt::format("{}", run.slam.keyScans())},
                 {"loops closed", fmt::format("{}", slam.loops_closed)},
                 {"time", fmt::format("{:.1f} s", run.wall_s)},
                 {"scans a second", fmt::format("{:.0f}", static_cast<double>(run.scans) / run.wall_s)}};
  writeMapOutputs(out, run.slam, run.track, shown);
  if (options.json) {
    show(figures.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return run.damage.empty() ? kDone : kFailed;
  }
  for (const std::string& warning : shown.warnings) show("note: " + warning + "\n");
  for (const auto& [label, value] : shown.facts) show(fmt::format("{:<14} {}\n", label, value));
  show(fmt::format("{}\n", (out / "report.html").string()));
  return run.damage.empty() ? kDone : kFailed;
}

}  // namespace

void addMap(CLI::App& program, Run& run) {
  auto options = std::make_shared<MapOptions>();
  auto* command = program.add_subcommand("map", "Make the map of a recorded laser log; no odometry is needed.");
  command
      ->add_option("log", options->log, "CARMEN, BreezySLAM .dat or rosbag 1; plain, or packed by gzip, bzip2 or xz.")
      ->required();
  command->add_option("--sensor", options->sensor,
                      "A data sheet of config/sensors or a file, where the log does not say what its laser is.");
  command
      ->add_option("--odometry", options->odometry,
                   "auto: the log's, as far as it proves right. none: as if it had none.")
      ->check(CLI::IsMember({"auto", "none"}))
      ->capture_default_str();
  command
      ->add_option("--slam", options->slam,
                   "graph: key scans tied by matches and loop closures. particles: trajectories with a map each.")
      ->check(CLI::IsMember({"graph", "particles"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the results; LOG-map when not given.");
  command->add_flag("--json", options->json, "Print the figures as JSON.");
  command->footer("Example: swiftlet map intel.clf.bz2 --out intel");
  command->callback([&run, options] { run = [options] { return map(*options); }; });
}

}  // namespace swiftlet::apps
