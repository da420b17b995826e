// swiftlet map: the map of a recorded laser log.
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/map_outputs.hpp"
#include "apps/progress_line.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "apps/system.hpp"
#include "apps/wall_clock.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// Ending of the folder's name for the results.
constexpr const char* kMapSuffix = "map";

struct MapOptions {
  RecordedLogOptions log;
  std::string slam;  ///< One of perception::slamMethodNames(). Empty: that of the profile.
};

perception::LaserSlamConfig configOf(const MapOptions& options) {
  perception::LaserSlamConfig config = laserSlamOf(loadSystem(options.log.system));
  if (!options.slam.empty()) config.slam.method = perception::slamMethodOf(options.slam);
  return config;
}

struct MapRun {
  explicit MapRun(const MapOptions& options) : slam(configOf(options)) {}

  perception::LaserSlam slam;
  TrackSpool track;
  rendering::ThinnedCurve milliseconds;
  std::uint64_t unmatched = 0;
  perception::MapJudgement judgement;  ///< Of the finished map.
  perception::TrackConnection connection;
  double wall_s = 0.0;
  double path_length_m = 0.0;  ///< Length of the robot's path.
};

/// Sums steps of at least this length, so that a standing robot adds nothing.
constexpr double kPathStep_m = 0.1;

double pathLength_m(const MapRun& run) {
  const std::vector<common::Pose2> keys = run.slam.keyPoses();
  std::optional<Eigen::Vector2d> last_m;
  double path_length_m = 0.0;
  run.track.forEach([&](const StampedScan& tracked) {
    const Eigen::Vector2d now_m = tracked.scan.T_map_robot(keys).position_m();
    const double step_m = last_m ? (now_m - *last_m).norm() : 0.0;
    if (last_m && step_m < kPathStep_m) return;
    path_length_m += step_m;
    last_m = now_m;
  });
  return path_length_m;
}

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
      line.update(log.reader().progress(),
                  fmt::format("{} scans, {} key scans, {}", log.scans(), run.slam.keyScans(),
                              plural(run.slam.slam().counts().loops_closed, "loop", "loops")),
                  secondsSince(begin));
  }
  run.slam.finish();
  run.judgement = run.slam.judgement();
  run.connection = run.slam.connection(run.judgement);
  run.wall_s = secondsSince(begin);
  run.path_length_m = pathLength_m(run);
  line.close();
}

/// Whether the map can be trusted, and why not.
struct Trust {
  bool trusted = false;
  std::string reason;
};

Trust trustOf(const RecordedLog& log, const MapRun& run) {
  const perception::TrackConnection& track = run.connection;
  if (std::string why_not = perception::whyNotTrusted(log.scans(), run.unmatched, track, run.judgement);
      !why_not.empty())
    return {false, std::move(why_not)};
  if (std::string why_not = log.whyBent(); !why_not.empty()) return {false, std::move(why_not)};
  if (track.breaks == 0) return {true, "the track was never lost"};
  return {true, fmt::format("the track was lost {}, and all its pieces are connected",
                            plural(track.breaks, "time", "times"))};
}

std::vector<std::string> warningsOf(const RecordedLog& log, const MapRun& run, const Trust& trust) {
  std::vector<std::string> warnings = log.warnings(run.slam.counts());
  if (log.scans() == 1) warnings.emplace_back("the map is that of a single scan: nothing confirms it");
  if (!trust.trusted) warnings.insert(warnings.begin(), "the map is probably wrong: " + trust.reason);
  if (const auto restarts = run.connection.breaks; trust.trusted && restarts > 0)
    warnings.push_back("the track was lost " + plural(restarts, "time", "times") +
                       " and begun anew where it was expected; all its pieces were connected again");
  return warnings;
}

/// Where the map contradicts itself, the worst place first.
nlohmann::ordered_json placesOf(const std::vector<perception::SeenTwice>& pairs) {
  nlohmann::ordered_json places = nlohmann::ordered_json::array();
  for (const perception::SeenTwice& pair : pairs)
    places.push_back({{"key_scans", {pair.first_key, pair.other_key}},
                      {"x_m", std::round(1e2 * pair.at_map_m.x()) / 1e2},
                      {"y_m", std::round(1e2 * pair.at_map_m.y()) / 1e2},
                      {"violation", std::round(1e3 * pair.violation) / 1e3}});
  return places;
}

nlohmann::ordered_json figuresOf(const MapOptions& options, const RecordedLog& log, const MapRun& run,
                                 const Trust& trust, const std::vector<std::string>& notes, const fs::path& out) {
  const interfaces::LaserLogCounts& read = log.reader().counts();
  return {{"log", options.log.file},
          {"format", log.reader().format()},
          {"out", out.string()},
          {"complete", log.damage().empty()},
          {"trusted", trust.trusted},
          {"trust_reason", trust.reason},
          {"scans", log.scans()},
          {"skipped_records", read.skipped_records},
          {"first_skipped_line", orNull<nlohmann::ordered_json>(log.firstSkippedLine())},
          {"invalid_ranges", read.invalid_ranges},
          {"unreliable_stamps", run.slam.counts().unreliable_stamps},
          {"implausible_odometry_steps", run.slam.counts().implausible_odometry},
          {"path_length_m", std::round(1e3 * run.path_length_m) / 1e3},
          {"unmatched_scans", run.unmatched},
          {"restarts", run.connection.breaks},
          {"unconnected_pieces", run.connection.unconnected},
          {"key_scans", run.slam.keyScans()},
          {"loops_closed", run.slam.slam().counts().loops_closed},
          {"places_seen_again", run.judgement.pairs()},
          {"violation", std::round(1e4 * run.judgement.violation()) / 1e4},
          {"contradictions", placesOf(run.judgement.contradicting)},
          {"seconds", run.wall_s},
          {"scans_per_s", static_cast<double>(log.scans()) / run.wall_s},
          {"notes", notes}};
}

using Facts = std::vector<std::pair<std::string, std::string>>;

Facts factsOf(const RecordedLog& log, const MapRun& run) {
  const auto scans = static_cast<double>(log.scans());
  Facts facts = log.facts();
  facts.insert(
      facts.end(),
      {{"path length", fmt::format("{:.1f} m", run.path_length_m)},
       {"not matched", fmt::format("{}", run.unmatched)},
       {"key scans", fmt::format("{}", run.slam.keyScans())},
       {"loops closed", run.slam.slam().hasGraph() ? fmt::format("{}", run.slam.slam().counts().loops_closed) : "-"},
       {"computing time", fmt::format("{:.1f} s", run.wall_s)},
       {"scans a second", fmt::format("{:.0f}", scans / run.wall_s)}});
  return facts;
}

int map(const MapOptions& options) {
  RecordedLog log(options.log);
  ResultsFolder folder(folderFor(options.log, kMapSuffix), kMapResults);
  const fs::path& out = folder.path();
  MapRun run(options);
  mapLog(log, options, run);
  if (run.slam.keyPoses().empty()) throw log.error("no map: " + log.whyNoPoints());
  if (!log.damage().empty()) showError(log.damage() + "\n");

  const common::OccupancyGrid grid = run.slam.map();
  const std::string no_map = whyNoMap(grid);
  Trust trust = trustOf(log, run);
  if (!no_map.empty()) trust = {false, no_map};
  MapFigures shown{options.log.file, factsOf(log, run), warningsOf(log, run, trust), {}, run.milliseconds};
  if (!trust.trusted) shown.contradicting = run.judgement.contradicting;
  if (!no_map.empty()) showError(no_map + "\n");
  writeMapOutputs(folder.unfinished(), run.slam, no_map.empty() ? &grid : nullptr, run.track, shown);
  folder.publish();
  const int exit_code = log.damage().empty() && no_map.empty() ? kDone : kFailed;
  if (options.log.json) {
    const nlohmann::ordered_json figures = figuresOf(options, log, run, trust, shown.warnings, out);
    showJson(figures.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return exit_code;
  }
  for (const std::string& warning : shown.warnings) show("note: " + warning + "\n");
  for (const auto& [label, value] : shown.facts) show(fmt::format("{:<14} {}\n", label, value));
  show(fmt::format("{}\n", (out / "report.html").string()));
  return exit_code;
}

}  // namespace

void addMap(Command& program) {
  auto options = std::make_shared<MapOptions>();
  Command command = program.command("map", "Make the map of a recorded laser log; no odometry is needed.");
  addLogOptions(command, options->log, kMapSuffix);
  command.choice("--slam", options->slam, perception::slamMethodNames(),
                 perception::slamMethodHelp() + " The profile's when not given.");
  command.footer("Example: swiftlet map intel.clf.bz2 --out intel");
  command.runs([options] { return map(*options); });
}

}  // namespace swiftlet::apps
