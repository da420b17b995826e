// swiftlet localize: where a recorded laser log was, in a given map.
#include <chrono>
#include <memory>
#include <optional>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/given_map.hpp"
#include "apps/localize_outputs.hpp"
#include "apps/numbers.hpp"
#include "apps/progress_line.hpp"
#include "apps/show.hpp"
#include "apps/system.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "perception/localization/log_localizer.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using perception::LocalizationState;

/// How well somebody knows where a robot stands who says so.
constexpr double kStart_m = 0.3;
constexpr double kStart_deg = 10.0;

struct LocalizeOptions {
  std::string map, log, sensor, start, out;
  std::string odometry = "auto";
  double seed = 1.0;
  bool json = false;
};

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// "logs/intel.clf.bz2" -> "intel-localize".
fs::path folderFor(const LocalizeOptions& options) {
  if (!options.out.empty()) return options.out;
  const std::string name = fs::path(options.log).filename().string();
  return name.substr(0, name.find('.')) + "-localize";
}

/// "x;y;yaw" in metres and degrees.
common::Pose2 parseStart(const std::string& text) {
  std::istringstream in(text);
  double x_m = NAN, y_m = NAN, yaw_deg = NAN;
  char first = 0, second = 0, rest = 0;
  in >> x_m >> first >> y_m >> second >> yaw_deg;
  if (!in || first != ';' || second != ';' || in >> rest || !std::isfinite(x_m + y_m + yaw_deg))
    throw common::InputError(common::Problem{
        {}, "--start", fmt::format("`{}` is not x;y;yaw", text), "metres and degrees, for instance 3.0;-1.5;90"});
  return {x_m, y_m, common::wrapAngle(yaw_deg * common::kRadPerDeg)};
}

struct LocalizeRun {
  std::uint64_t scans = 0, localized = 0, times_localized = 0, times_lost = 0;
  LocalizationState state = LocalizationState::kGlobal;
  LocalizeFigures shown;
  double wall_s = 0.0;
};

/// The event, stamped as the log is; `run.state` is that before it.
void note(const perception::LocalizationEvent& event, common::Time stamp, LocalizeRun& run) {
  run.times_localized += event.state == LocalizationState::kLocalized ? 1 : 0;
  const bool lost = event.state == LocalizationState::kLost;
  run.times_lost += lost && run.state == LocalizationState::kLocalized ? 1 : 0;
  run.shown.events.push_back({stamp, lost ? common::Severity::kWarning : common::Severity::kInfo, "localization",
                              toString(event.state), event.reason});
}

void localizeLog(interfaces::LaserLog& log, const LocalizeOptions& options, perception::LogLocalizer& localizer,
                 interfaces::TumWriter& trajectory, LocalizeRun& run) {
  const auto begin = Clock::now();
  ProgressLine line(options.json);
  while (const auto logged = log.next()) {
    perception::LaserSlamInput input{logged->scan, logged->T_robot_laser, logged->T_odom_robot};
    if (options.odometry == "none") input.T_odom_robot.reset();
    const auto scan_begin = Clock::now();
    const auto estimate = localizer.add(input);
    const auto index = static_cast<double>(run.scans++);
    run.shown.milliseconds.add(index, 1e3 * secondsSince(scan_begin));
    if (!estimate) continue;
    const common::Time stamp = logged->scan.stamps.measured;
    run.shown.ways.add(*estimate);
    if (estimate->event) note(*estimate->event, stamp, run);
    run.state = estimate->state;
    if (estimate->state == LocalizationState::kLocalized) {
      ++run.localized;
      run.shown.unexplained.add(index, 100.0 * (1.0 - estimate->explained));
      if (const auto written = trajectory.write({stamp, common::lifted(estimate->T_map_body, 0.0)}); !written)
        throw common::InputError(common::Problem{{}, "", written.error().message, ""});
    }
    if (run.scans % 50 == 0)
      line.update(fmt::format("{:3.0f} %  {} scans, {}", 100.0 * log.progress(), run.scans, toString(run.state)),
                  secondsSince(begin));
  }
  run.wall_s = secondsSince(begin);
  line.close();
}

std::vector<std::string> warningsOf(const interfaces::LaserLog& log, const perception::LogLocalizerCounts& counts) {
  std::vector<std::string> warnings;
  if (const auto n = log.counts().skipped_records; n > 0) {
    warnings.push_back(fmt::format("records that could not be read and were skipped: {}", n));
    for (const common::Problem& problem : log.counts().first_problems) warnings.push_back(toString(problem));
  }
  if (const auto n = log.counts().invalid_ranges; n > 0)
    warnings.push_back(fmt::format("ranges that are negative or not a number: {}", n));
  if (const auto n = counts.doubtful_stamps; n > 0)
    warnings.push_back(fmt::format(
        "time stamps that do not come after the one before: {}; the order of the file is believed, not the intervals",
        n));
  if (const auto n = counts.doubtful_odometry; n > 0)
    warnings.push_back(fmt::format("steps of the odometry no robot makes: {}; not believed", n));
  if (const auto n = counts.breaks; n > 0)
    warnings.push_back(fmt::format("times the scans did not follow on each other: {}", n));
  return warnings;
}

nlohmann::ordered_json figuresOf(const LocalizeOptions& options, const LocalizeRun& run,
                                 const perception::LogLocalizerCounts& counts, const fs::path& out) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const common::Event& event : run.shown.events)
    events.push_back({{"t_s", event.stamp.seconds()}, {"state", event.text}, {"reason", event.reason}});
  return {{"map", options.map},
          {"log", options.log},
          {"out", out.string()},
          {"scans", run.scans},
          {"localized_scans", run.localized},
          {"times_localized", run.times_localized},
          {"times_lost", run.times_lost},
          {"state_at_end", toString(run.state)},
          {"doubtful_stamps", counts.doubtful_stamps},
          {"breaks", counts.breaks},
          {"events", events},
          {"seconds", run.wall_s},
          {"scans_per_s", run.wall_s > 0.0 ? static_cast<double>(run.scans) / run.wall_s : 0.0}};
}

void showForPeople(const LocalizeRun& run, const fs::path& out) {
  for (const std::string& warning : run.shown.warnings) show("note: " + warning + "\n");
  for (const common::Event& event : run.shown.events)
    show(fmt::format("{:.3f} s  {}: {}\n", event.stamp.seconds(), event.text, event.reason));
  for (const auto& [label, value] : run.shown.facts) show(fmt::format("{:<14} {}\n", label, value));
  show(fmt::format("{}\n", (out / "report.html").string()));
}

int localize(const LocalizeOptions& options) {
  const interfaces::StoredMap map = readUsableMap(options.map);
  interfaces::LaserLogOptions log_options;
  if (!options.sensor.empty()) log_options.sensor = loadLaser(options.sensor);
  perception::LogLocalizer localizer(map.grid, map.T_map_grid, {}, static_cast<std::uint64_t>(options.seed));
  LocalizeRun run;
  if (!options.start.empty()) {
    const double yaw_rad = kStart_deg * common::kRadPerDeg;
    localizer.localizer().startAt(
        parseStart(options.start),
        Eigen::Vector3d(kStart_m * kStart_m, kStart_m * kStart_m, yaw_rad * yaw_rad).asDiagonal());
  }
  const auto log = interfaces::openLaserLog(options.log, log_options);
  const fs::path out = folderFor(options);
  std::error_code failure;
  fs::create_directories(out, failure);
  auto trajectory = interfaces::TumWriter::create(out / "trajectory.tum");
  if (!trajectory) throw common::InputError(common::Problem{{}, "", trajectory.error().message, ""});
  localizeLog(*log, options, localizer, *trajectory, run);
  if (run.scans == 0)
    throw common::InputError(common::Problem{{options.log},
                                             "",
                                             "no scan in it could be read",
                                             log->counts().first_problems.empty()
                                                 ? ""
                                                 : "first problem: " + toString(log->counts().first_problems.front())});

  const perception::LogLocalizerCounts counts = localizer.counts();
  run.shown.map = options.map;
  run.shown.log = options.log;
  run.shown.warnings = warningsOf(*log, counts);
  run.shown.facts = {{"scans", fmt::format("{}", run.scans)},
                     {"localized", fmt::format("{:.1f} %", 100.0 * static_cast<double>(run.localized) /
                                                               static_cast<double>(run.scans))},
                     {"times lost", fmt::format("{}", run.times_lost)},
                     {"at the end", toString(run.state)},
                     {"time", fmt::format("{:.1f} s", run.wall_s)},
                     {"scans a second", fmt::format("{:.0f}", static_cast<double>(run.scans) / run.wall_s)}};
  writeLocalizeOutputs(out, map, run.shown);
  options.json ? show(figuresOf(options, run, counts, out).dump(2) + "\n") : showForPeople(run, out);
  if (run.times_localized > 0 || (!options.start.empty() && run.localized > 0)) return kDone;
  if (!options.json) show("never localized: is the log of another place, or floor?\n");
  return kFailed;
}

}  // namespace

void addLocalize(CLI::App& program, Run& run) {
  auto options = std::make_shared<LocalizeOptions>();
  auto* command = program.add_subcommand("localize", "Find and follow a recorded laser log in a given map.");
  command->add_option("map", options->map, "The map's YAML, as map_server and swiftlet map write it.")->required();
  command->add_option("log", options->log, "CARMEN log; plain, .gz, .bz2 or .xz.")->required();
  command->add_option("--start", options->start,
                      "\"x;y;yaw\" where it begins, in metres and degrees; not known when not given.");
  command->add_option("--sensor", options->sensor,
                      "A data sheet of config/sensors or a file, where the log does not say what its laser is.");
  command
      ->add_option("--odometry", options->odometry,
                   "auto: the log's, as far as it proves right. none: as if it had none.")
      ->check(CLI::IsMember({"auto", "none"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the results; LOG-localize when not given.");
  command->add_option("--seed", options->seed, "Of the particles.")
      ->check(numberWithin(0.0, kGreatestSeed))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the figures as JSON.");
  command->footer("Example: swiftlet localize intel/map.yaml intel.clf.bz2 --out intel-localize");
  command->callback([&run, options] { run = [options] { return localize(*options); }; });
}

}  // namespace swiftlet::apps
