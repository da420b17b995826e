// swiftlet map: the map of a recorded laser log.
#include <cmath>
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/log_mapping.hpp"
#include "apps/map_outputs.hpp"
#include "apps/progress_line.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "flight/system.hpp"
#include "flight/wall_clock.hpp"

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
  perception::LaserSlamConfig config = flight::laserSlamOf(flight::loadSystem(options.log.system));
  if (!options.slam.empty()) config.slam.method = perception::slamMethodOf(options.slam);
  return config;
}

struct MapRun {
  explicit MapRun(const MapOptions& options) : mapping(configOf(options)) {}

  LogMapping mapping;
  rendering::ThinnedCurve milliseconds;
  double wall_s = 0.0;
  double path_length_m = 0.0;  ///< Length of the robot's path.
};

void mapLog(RecordedLog& log, const MapOptions& options, MapRun& run) {
  const auto begin = flight::Clock::now();
  const perception::LaserSlam& slam = run.mapping.slam;
  ProgressLine line(options.log.json);
  while (const auto logged = log.next()) {
    const auto scan_begin = flight::Clock::now();
    const auto tracked = run.mapping.add(logged->scan.stamps.measured, log.inputOf(*logged));
    run.milliseconds.add(static_cast<double>(log.scans() - 1), 1e3 * flight::secondsSince(scan_begin));
    if (tracked && log.scans() % 50 == 0)
      line.update(log.reader().progress(),
                  fmt::format("{} scans, {} key scans, {}", log.scans(), slam.keyScans(),
                              plural(slam.slam().counts().loops_closed, "loop", "loops")),
                  flight::secondsSince(begin));
  }
  run.mapping.finish();
  run.wall_s = flight::secondsSince(begin);
  run.path_length_m = run.mapping.pathLength_m();
  line.close();
}

std::vector<std::string> warningsOf(const RecordedLog& log, const MapRun& run, const Trust& trust) {
  std::vector<std::string> warnings = log.warnings(run.mapping.slam.counts());
  if (log.scans() == 1) warnings.emplace_back("the map is that of a single scan: nothing confirms it");
  if (!trust.trusted) warnings.insert(warnings.begin(), "the map is probably wrong: " + trust.reason);
  if (const auto restarts = run.mapping.connection.breaks; trust.trusted && restarts > 0)
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
          {"unreliable_stamps", run.mapping.slam.counts().unreliable_stamps},
          {"implausible_odometry_steps", run.mapping.slam.counts().implausible_odometry},
          {"path_length_m", std::round(1e3 * run.path_length_m) / 1e3},
          {"unmatched_scans", run.mapping.unmatched},
          {"restarts", run.mapping.connection.breaks},
          {"unconnected_pieces", run.mapping.connection.unconnected},
          {"key_scans", run.mapping.slam.keyScans()},
          {"loops_closed", run.mapping.slam.slam().counts().loops_closed},
          {"places_seen_again", run.mapping.judgement.pairs()},
          {"violation", std::round(1e4 * run.mapping.judgement.violation()) / 1e4},
          {"contradictions", placesOf(run.mapping.judgement.contradicting)},
          {"seconds", run.wall_s},
          {"scans_per_s", static_cast<double>(log.scans()) / run.wall_s},
          {"notes", notes}};
}

using Facts = std::vector<std::pair<std::string, std::string>>;

Facts factsOf(const RecordedLog& log, const MapRun& run) {
  const auto scans = static_cast<double>(log.scans());
  Facts facts = log.facts();
  facts.insert(facts.end(), {{"path length", fmt::format("{:.1f} m", run.path_length_m)},
                             {"not matched", fmt::format("{}", run.mapping.unmatched)},
                             {"key scans", fmt::format("{}", run.mapping.slam.keyScans())},
                             {"loops closed", run.mapping.slam.slam().method() == perception::SlamMethod::kGraph
                                                  ? fmt::format("{}", run.mapping.slam.slam().counts().loops_closed)
                                                  : "-"},
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
  if (run.mapping.slam.keyPoses().empty()) throw log.unusable("no map: ");
  if (!log.damage().empty()) showError(log.damage() + "\n");

  const common::OccupancyGrid grid = run.mapping.slam.map();
  const std::string no_map = whyNoMap(grid);
  Trust trust = run.mapping.trust(log.whyBent());
  if (!no_map.empty()) trust = {false, no_map};
  MapFigures shown{options.log.file, factsOf(log, run), warningsOf(log, run, trust), {}, run.milliseconds};
  if (!trust.trusted) shown.contradicting = run.mapping.judgement.contradicting;
  if (!no_map.empty()) showError(no_map + "\n");
  writeMapOutputs(folder.unfinished(), run.mapping.slam, no_map.empty() ? &grid : nullptr, run.mapping.track, shown);
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
