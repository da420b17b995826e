// swiftlet map: the map of a recorded laser log.
#include <memory>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/map_outputs.hpp"
#include "apps/progress_line.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "apps/wall_clock.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// Ends the name of the folder for the results.
constexpr const char* kSuffix = "map";

struct MapOptions {
  RecordedLogOptions log;
  std::string slam = "graph";
};

perception::LaserSlamConfig configOf(const MapOptions& options) {
  perception::LaserSlamConfig config;
  if (options.slam == "particles") config.method = perception::SlamMethod::kParticles;
  return config;
}

struct MapRun {
  explicit MapRun(const MapOptions& options) : slam(configOf(options)) {}

  perception::LaserSlam slam;
  TrackSpool track;
  rendering::ThinnedCurve milliseconds;
  std::uint64_t unmatched = 0;
  double wall_s = 0.0;
};

void mapLog(RecordedLog& log, const MapOptions& options, MapRun& run) {
  const auto begin = Clock::now();
  ProgressLine line(options.log.json);
  while (const auto logged = log.next()) {
    const auto scan_begin = Clock::now();
    const auto tracked = run.slam.add(log.inputOf(*logged));
    run.milliseconds.add(static_cast<double>(log.scans() - 1), 1e3 * secondsSince(scan_begin));
    if (!tracked) continue;
    run.unmatched += tracked->matched ? 0 : 1;
    run.track.add({logged->scan.stamps.measured, *tracked});
    if (log.scans() % 50 == 0)
      line.update(fmt::format("{:3.0f} %  {} scans, {} key scans, {} loops", 100.0 * log.reader().progress(),
                              log.scans(), run.slam.keyScans(), run.slam.slam().counts().loops_closed),
                  secondsSince(begin));
  }
  run.slam.finish();
  run.wall_s = secondsSince(begin);
  line.close();
}

std::vector<std::string> warningsOf(const RecordedLog& log, const MapRun& run) {
  std::vector<std::string> warnings = log.warnings(run.slam.counts());
  if (const auto n = run.slam.odometryCounts().restarts; n > 0)
    warnings.push_back("the track was lost " + plural(n, "time", "times") + " and begun anew where it was expected");
  return warnings;
}

nlohmann::ordered_json figuresOf(const MapOptions& options, const RecordedLog& log, const MapRun& run,
                                 const fs::path& out) {
  const interfaces::LaserLogCounts& read = log.reader().counts();
  return {{"log", options.log.file},
          {"format", log.reader().format()},
          {"out", out.string()},
          {"complete", log.damage().empty()},
          {"scans", log.scans()},
          {"skipped_records", read.skipped_records},
          {"invalid_ranges", read.invalid_ranges},
          {"doubtful_stamps", run.slam.counts().doubtful_stamps},
          {"doubtful_odometry_steps", run.slam.counts().doubtful_odometry},
          {"unmatched_scans", run.unmatched},
          {"restarts", run.slam.odometryCounts().restarts},
          {"key_scans", run.slam.keyScans()},
          {"loops_closed", run.slam.slam().counts().loops_closed},
          {"seconds", run.wall_s},
          {"scans_per_s", static_cast<double>(log.scans()) / run.wall_s},
          {"notes", warningsOf(log, run)}};
}

int map(const MapOptions& options) {
  RecordedLog log(options.log);
  ResultsFolder folder(folderFor(options.log, kSuffix), kMapResults);
  const fs::path& out = folder.path();
  MapRun run(options);
  mapLog(log, options, run);
  if (run.slam.keyPoses().empty())
    throw log.error(fmt::format("no map: none of its {} scans has points enough", log.scans()));

  const int exit_code = log.damage().empty() ? kDone : kFailed;
  if (exit_code != kDone) fmt::print(stderr, "{}\n", log.damage());
  const nlohmann::ordered_json figures = figuresOf(options, log, run, out);
  MapFigures shown{options.log.file, {}, warningsOf(log, run), run.milliseconds};
  shown.facts = {{"log", log.reader().format()},
                 {"scans", fmt::format("{}", log.scans())},
                 {"not matched", fmt::format("{}", run.unmatched)},
                 {"key scans", fmt::format("{}", run.slam.keyScans())},
                 {"loops closed", fmt::format("{}", run.slam.slam().counts().loops_closed)},
                 {"time", fmt::format("{:.1f} s", run.wall_s)},
                 {"scans a second", fmt::format("{:.0f}", static_cast<double>(log.scans()) / run.wall_s)}};
  writeMapOutputs(folder.unfinished(), run.slam, run.track, shown);
  folder.publish();
  if (options.log.json) {
    show(figures.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return exit_code;
  }
  for (const std::string& warning : shown.warnings) show("note: " + warning + "\n");
  for (const auto& [label, value] : shown.facts) show(fmt::format("{:<14} {}\n", label, value));
  show(fmt::format("{}\n", (out / "report.html").string()));
  return exit_code;
}

}  // namespace

void addMap(CLI::App& program, Run& run) {
  auto options = std::make_shared<MapOptions>();
  auto* command = program.add_subcommand("map", "Make the map of a recorded laser log; no odometry is needed.");
  addLogOptions(*command, options->log, kSuffix);
  command
      ->add_option("--slam", options->slam,
                   "graph: key scans tied by matches and loop closures. particles: trajectories with a map each.")
      ->check(CLI::IsMember({"graph", "particles"}))
      ->capture_default_str();
  command->footer("Example: swiftlet map intel.clf.bz2 --out intel");
  command->callback([&run, options] { run = [options] { return map(*options); }; });
}

}  // namespace swiftlet::apps
