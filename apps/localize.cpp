// swiftlet localize: where a recorded laser log was, in a given map.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/listed_numbers.hpp"
#include "apps/localize_outputs.hpp"
#include "apps/progress_line.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "flight/given_map.hpp"
#include "flight/system.hpp"
#include "flight/wall_clock.hpp"
#include "perception/localization/log_localizer.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using perception::LocalizationState;

/// Standard deviations of a start that the user gives.
constexpr double kStart_m = 0.3;
constexpr double kStart_deg = 10.0;

/// Ending of the folder's name for the results.
constexpr const char* kLocalizeSuffix = "localize";

struct LocalizeOptions {
  RecordedLogOptions log;
  std::string map, start;
  int seed = 1;
};

/// "x;y;yaw" in metres and degrees.
common::Pose2 startInMap(const std::string& text) {
  const std::vector<double> start = listedNumbers(text);
  if (start.size() != 3)
    throw common::InputError(
        {}, "--start", common::Message("start.no-place", "`{}` is not a place x;y;yaw in metres and degrees", text),
        "for instance 3.0;-1.5;90");
  return {start[0], start[1], common::wrapAngle(start[2] * common::kRadPerDeg)};
}

/// Throws InputError for a start outside the map: no measurement there could contradict it.
void refuseOutside(const common::Pose2& T_map_start, const interfaces::StoredMap& map, const std::string& text) {
  const Eigen::Vector2d start_grid_m = map.T_map_grid.inverse() * T_map_start.position_m();
  const common::CellRect known = common::knownExtent(map.grid);
  const Eigen::Vector2d low_grid_m = Eigen::Vector2d(known.begin.x, known.begin.y) * map.grid.resolution_m();
  const Eigen::Vector2d high_grid_m = Eigen::Vector2d(known.end.x, known.end.y) * map.grid.resolution_m();
  if ((start_grid_m.array() >= low_grid_m.array()).all() && (start_grid_m.array() <= high_grid_m.array()).all()) return;
  const Eigen::Vector2d a_m = map.T_map_grid * low_grid_m, b_m = map.T_map_grid * high_grid_m;
  throw common::InputError(
      {}, "--start", common::Message("start.outside-map", "`{}` lies outside the map", text),
      fmt::format("two of its corners are {:.1f};{:.1f} and {:.1f};{:.1f}", a_m.x(), a_m.y(), b_m.x(), b_m.y()));
}

/// The pose was lost after this one.
struct Loss {
  common::Time stamp;
  std::uint64_t scan = 0;
  common::Pose2 T_map_body;  ///< The last localized pose.
  std::string reason;
  std::uint64_t scans = 0;  ///< Number of scans until it was localized again, or to the end.
};

struct LocalizeRun {
  std::uint64_t estimates = 0;  ///< Number of scans since the first one with enough points.
  std::uint64_t localized = 0, times_localized = 0;
  LocalizationState state = LocalizationState::kGlobal;
  bool refuted = false;      ///< At the last scan.
  common::Pose2 T_map_body;  ///< The last localized pose.
  std::vector<Loss> losses;
  LocalizeFigures shown;
  double wall_s = 0.0;

  /// Whether the map is of another place than the log; nullopt if that is not known. `given`: the start was given.
  std::optional<bool> wrongMap(bool given) const {
    if (refuted) return true;
    const bool found = times_localized > (given ? 1U : 0U) || state == LocalizationState::kLocalized;
    return found ? std::optional(false) : std::nullopt;
  }
};

/// The event with the stamp of the log; `run.state` is the state before it.
void note(const perception::LocalizationEvent& event, common::Time stamp, std::uint64_t scan, LocalizeRun& run) {
  run.times_localized += event.state == LocalizationState::kLocalized ? 1 : 0;
  const bool lost = event.state == LocalizationState::kLost;
  if (lost && run.state == LocalizationState::kLocalized)
    run.losses.push_back({stamp, scan, run.T_map_body, event.reason, 0});
  run.shown.events.push_back({{stamp, lost ? common::Severity::kWarning : common::Severity::kInfo, "localization",
                               toString(event.state), event.reason},
                              scan});
}

void localizeLog(RecordedLog& log, const LocalizeOptions& options, perception::LogLocalizer& localizer,
                 LocalizeRun& run) {
  const auto begin = flight::Clock::now();
  ProgressLine line(options.log.json);
  while (const auto logged = log.next()) {
    const auto scan_begin = flight::Clock::now();
    const auto estimate = localizer.add(log.inputOf(*logged));
    const auto index = static_cast<double>(log.scans() - 1);
    run.shown.milliseconds.add(index, 1e3 * flight::secondsSince(scan_begin));
    if (!estimate) continue;
    ++run.estimates;
    const common::Time stamp = logged->scan.stamps.measured;
    run.shown.paths.add(*estimate);
    if (estimate->event) note(*estimate->event, stamp, log.scans() - 1, run);
    run.state = estimate->state;
    run.refuted = estimate->refuted;
    if (estimate->state != LocalizationState::kLocalized && !run.losses.empty()) ++run.losses.back().scans;
    if (estimate->state == LocalizationState::kLocalized) {
      ++run.localized;
      run.T_map_body = estimate->T_map_body;
      run.shown.unexplained.add(index, 100.0 * (1.0 - estimate->explained));
      run.shown.track.add({stamp, estimate->T_map_body});
    }
    if (log.scans() % 50 == 0)
      line.update(log.reader().progress(), fmt::format("{} scans, {}", log.scans(), toString(run.state)),
                  flight::secondsSince(begin));
  }
  run.wall_s = flight::secondsSince(begin);
  line.close();
}

std::vector<std::string> warningsOf(const interfaces::StoredMap& map, const RecordedLog& log,
                                    const perception::LogLocalizerCounts& counts) {
  std::vector<std::string> warnings;
  for (const common::Problem& note : map.notes) warnings.push_back(toString(note));
  for (std::string& warning : log.warnings(counts.front_end)) warnings.push_back(std::move(warning));
  if (const auto n = counts.breaks; n > 0)
    warnings.push_back(plural(n, "time", "times") + " the scans did not follow on each other");
  return warnings;
}

double hundredth(double value) { return std::round(1e2 * value) / 1e2; }

nlohmann::ordered_json lossesOf(const LocalizeRun& run) {
  nlohmann::ordered_json losses = nlohmann::ordered_json::array();
  for (const Loss& loss : run.losses)
    losses.push_back({{"t_s", loss.stamp.seconds()},
                      {"scan", loss.scan},
                      {"x_m", hundredth(loss.T_map_body.x_m)},
                      {"y_m", hundredth(loss.T_map_body.y_m)},
                      {"reason", loss.reason},
                      {"scans_lost", loss.scans}});
  return losses;
}

double localizedShare(const RecordedLog& log, const LocalizeRun& run) {
  return static_cast<double>(run.localized) / static_cast<double>(log.scans());
}

nlohmann::ordered_json figuresOf(const LocalizeOptions& options, const RecordedLog& log, const LocalizeRun& run,
                                 const perception::LogLocalizerCounts& counts, const fs::path& out) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const auto& [event, scan] : run.shown.events)
    events.push_back({{"t_s", event.stamp.seconds()}, {"scan", scan}, {"state", event.text}, {"reason", event.reason}});
  return {{"map", options.map},
          {"log", options.log.file},
          {"out", out.string()},
          {"complete", log.damage().empty()},
          {"scans", log.scans()},
          {"skipped_records", log.reader().counts().skipped_records},
          {"first_skipped_line", orNull<nlohmann::ordered_json>(log.firstSkippedLine())},
          {"localized_scans", run.localized},
          {"localized_share", std::round(1e4 * localizedShare(log, run)) / 1e4},
          {"wrong_map", orNull<nlohmann::ordered_json>(run.wrongMap(!options.start.empty()))},
          {"times_localized", run.times_localized},
          {"times_lost", run.losses.size()},
          {"losses", lossesOf(run)},
          {"state_at_end", toString(run.state)},
          {"unreliable_stamps", counts.front_end.unreliable_stamps},
          {"breaks", counts.breaks},
          {"events", events},
          {"seconds", run.wall_s},
          {"scans_per_s", run.wall_s > 0.0 ? static_cast<double>(log.scans()) / run.wall_s : 0.0},
          {"notes", run.shown.warnings}};
}

void showForPeople(const LocalizeRun& run, const fs::path& out) {
  for (const std::string& warning : run.shown.warnings) show("note: " + warning + "\n");
  for (const ReportedEvent& event : reported(run.shown.events, run.shown.has_stamps))
    show(fmt::format("{}  {}: {}\n", event.when, event.state, event.reason));
  for (const auto& [label, value] : run.shown.facts) show(fmt::format("{:<14} {}\n", label, value));
  show(fmt::format("{}\n", (out / "report.html").string()));
}

std::string wordFor(std::optional<bool> wrong_map) {
  if (!wrong_map) return "not known";
  return *wrong_map ? "yes: the log is of another place" : "no";
}

std::vector<std::pair<std::string, std::string>> factsOf(const RecordedLog& log, const LocalizeRun& run, bool given) {
  auto facts = log.facts();
  facts.insert(facts.end(), {{"localized", fmt::format("{:.1f} %", 100.0 * localizedShare(log, run))},
                             {"wrong map", wordFor(run.wrongMap(given))},
                             {"times lost", fmt::format("{}", run.losses.size())},
                             {"at the end", toString(run.state)},
                             {"computing time", fmt::format("{:.1f} s", run.wall_s)},
                             {"scans a second", fmt::format("{:.0f}", static_cast<double>(log.scans()) / run.wall_s)}});
  return facts;
}

int localize(const LocalizeOptions& options) {
  const interfaces::StoredMap map = flight::readUsableMap(options.map);
  const flight::System system = flight::loadSystem(options.log.system);
  perception::LogLocalizer localizer(
      map.grid, map.T_map_grid,
      {flight::laserSlamOf(system).front_end, system.config.autonomy.estimator.localization.localizer},
      static_cast<std::uint64_t>(options.seed));
  if (!options.start.empty()) {
    const common::Pose2 T_map_start = startInMap(options.start);
    refuseOutside(T_map_start, map, options.start);
    const double yaw_rad = kStart_deg * common::kRadPerDeg;
    localizer.localizer().startAt(
        T_map_start, Eigen::Vector3d(kStart_m * kStart_m, kStart_m * kStart_m, yaw_rad * yaw_rad).asDiagonal());
  }
  RecordedLog log(options.log);
  ResultsFolder folder(folderFor(options.log, kLocalizeSuffix), kLocalizeResults);
  const fs::path& out = folder.path();
  LocalizeRun run;
  localizeLog(log, options, localizer, run);
  if (run.estimates == 0) throw log.unusable("not localized: ");
  if (!log.damage().empty()) showError(log.damage() + "\n");

  const perception::LogLocalizerCounts counts = localizer.counts();
  run.shown.map = options.map;
  run.shown.log = options.log.file;
  run.shown.warnings = warningsOf(map, log, counts);
  run.shown.has_stamps = !log.hasOneStamp();
  run.shown.facts = factsOf(log, run, !options.start.empty());
  writeLocalizeOutputs(folder.unfinished(), map, run.shown);
  folder.publish();
  if (options.log.json)
    showJson(figuresOf(options, log, run, counts, out).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
             "\n");
  else
    showForPeople(run, out);
  // A given start counts as localized until something contradicts it.
  const bool given = !options.start.empty(), given_lost = given && !run.losses.empty();
  const bool localized = run.localized > 0 && (run.times_localized > (given ? 1U : 0U) || (given && !given_lost));
  if (!localized && !options.log.json)
    show(given_lost    ? "the given start was followed until it was lost, and no place found since: was it right?\n"
         : run.refuted ? "never localized: the log is of another place, or floor\n"
                       : "never localized: is the log of another place, or floor?\n");
  return localized && log.damage().empty() ? kDone : kFailed;
}

}  // namespace

void addLocalize(Command& program) {
  auto options = std::make_shared<LocalizeOptions>();
  Command command = program.command("localize", "Find and follow a recorded laser log in a given map.");
  command.argument("map", options->map, "The map's YAML, as map_server and swiftlet map write it.");
  addLogOptions(command, options->log, kLocalizeSuffix);
  command.option("--start", options->start,
                 "\"x;y;yaw\" where it begins, in metres and degrees; not known when not given.");
  command.option("--seed", options->seed, {0, simulation::kGreatestSeed}, "Seed of the particles.");
  command.footer("Example: swiftlet localize intel/map.yaml intel.clf.bz2 --out intel-localize");
  command.runs([options] { return localize(*options); });
}

}  // namespace swiftlet::apps
