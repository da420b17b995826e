#include "apps/recorded_log.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "common/median_step.hpp"
#include "flight/system.hpp"
#include "interfaces/files/stamp_units.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<interfaces::LaserLog> opened(const RecordedLogOptions& options) {
  interfaces::LaserLogOptions log_options;
  if (!options.sensor.empty()) log_options.sensor = flight::loadLaser(options.sensor);
  return interfaces::openLaserLog(options.file, log_options);
}

/// This many stamps determine the rate of a laser.
constexpr std::size_t kFirstStamps = 1000;

/// The name without the first of these endings that it has.
std::string without(std::string name, std::initializer_list<std::string_view> endings) {
  for (const std::string_view ending : endings)
    if (name.size() > ending.size() && name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  return name;
}

}  // namespace

void addLogOptions(Command& command, RecordedLogOptions& options, const std::string& suffix) {
  command.argument("log", options.file, "CARMEN, BreezySLAM .dat or rosbag 1; plain, or packed by gzip, bzip2 or xz.");
  command.option("--sensor", options.sensor,
                 "A data sheet of config/sensors or a file, where the log does not say what its laser is.");
  command.choice("--odometry", options.odometry, {"auto", "none"},
                 "auto: the log's, as far as it proves right. none: as if it had none.");
  command.option("--system", options.system, "A profile of config/systems, or a file: its odometry and SLAM.");
  command.option("--out", options.out, fmt::format("Folder for the results; LOG-{} when not given.", suffix));
  command.flag("--json", options.json, "Print the figures as JSON.");
}

fs::path folderFor(const RecordedLogOptions& options, const std::string& suffix) {
  if (!options.out.empty()) return options.out;
  // Only known endings are removed: day.01.clf and day.02.clf are two logs.
  const std::string unpacked = interfaces::unpackedName(options.file).filename().string();
  return fmt::format("{}-{}", without(unpacked, {".clf", ".log", ".bag", ".dat", ".txt"}), suffix);
}

std::string plural(std::uint64_t count, const std::string& one, const std::string& more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

RecordedLog::RecordedLog(const RecordedLogOptions& options)
    : RecordedLog(opened(options), options.file, options.odometry != "none") {}

RecordedLog::RecordedLog(std::unique_ptr<interfaces::LaserLog> log, std::string file, bool uses_odometry)
    : file_(std::move(file)), uses_odometry_(uses_odometry), swept_(std::move(log)) {}

std::optional<SweptScan> RecordedLog::next() {
  auto logged = swept_.next();
  if (!logged) return logged;
  ++scans_;
  countRanges(logged->scan);
  countStamp(logged->scan.stamps.measured);
  return logged;
}

perception::LaserSlamInput RecordedLog::inputOf(const SweptScan& logged) const {
  perception::LaserSlamInput input{logged.scan, logged.T_robot_laser,
                                   uses_odometry_ ? logged.T_odom_robot : std::nullopt};
  if (!logged.motion) return input;
  input.motion = &*logged.motion;
  // The motion from sweep to sweep serves as odometry where there is no other.
  if (!input.T_odom_robot) input.T_odom_robot = logged.motion->at(0.0);
  return input;
}

std::vector<std::string> RecordedLog::warnings(const perception::LaserSlamCounts& found) const {
  std::vector<std::string> warnings = reader().notes();
  if (!damage().empty()) warnings.push_back("only what came before could be read: " + damage());
  if (const auto n = reader().counts().skipped_records; n > 0) {
    warnings.push_back(plural(n, "record could not be read and was", "records could not be read and were") +
                       " skipped" +
                       (firstSkippedLine() ? fmt::format(", the first in line {}", *firstSkippedLine()) : ""));
    for (const common::Problem& problem : reader().counts().first_problems) warnings.push_back(toString(problem));
  }
  if (const auto n = reader().counts().invalid_ranges; n > 0)
    warnings.push_back(plural(n, "range is", "ranges are") + " negative or not a number");
  if (const std::string note = stampNote(); !note.empty()) warnings.push_back(note);
  if (std::string note = swept_.unknownTime(); !note.empty()) warnings.push_back(std::move(note));
  if (hasOneStamp())
    warnings.push_back(
        fmt::format("all scans have the same stamp, {:.3f} s: the order of the file is believed; the poses of the "
                    "trajectory cannot be told apart by time, and `evaluate` cannot pair them",
                    first_stamp_->seconds()));
  else if (const auto n = found.unreliable_stamps; n > 0)
    warnings.push_back(plural(n, "time stamp does", "time stamps do") +
                       " not follow the one before at a laser's pace: the order of the file is believed, not the "
                       "intervals");
  if (const auto n = found.implausible_odometry; n > 0)
    warnings.push_back(plural(n, "step", "steps") + " of the odometry no robot makes; not believed");
  return warnings;
}

std::optional<int> RecordedLog::firstSkippedLine() const {
  const std::vector<common::Problem>& problems = reader().counts().first_problems;
  if (problems.empty() || problems.front().location.line == 0) return std::nullopt;
  return problems.front().location.line;
}

std::vector<std::pair<std::string, std::string>> RecordedLog::facts() const {
  std::vector<std::pair<std::string, std::string>> facts{{"format", reader().format()},
                                                         {"scans", fmt::format("{}", scans_)}};
  if (duration_s_ > 0.0) facts.emplace_back("duration", fmt::format("{:.1f} s", duration_s_));
  return facts;
}

void RecordedLog::countStamp(common::Time stamp) {
  if (!first_stamp_) first_stamp_ = stamp;
  if (first_stamps_.size() < kFirstStamps) first_stamps_.push_back(stamp);
  duration_s_ = (stamp - *first_stamp_).seconds();
  stamps_differ_ = stamps_differ_ || stamp != *first_stamp_;
}

std::string RecordedLog::stampNote() const {
  const double step_s = common::medianStep_s(first_stamps_, [](common::Time stamp) { return stamp; });
  return reader().hasMicroseconds() ? interfaces::microsecondStepNote(step_s) : interfaces::stampStepNote(step_s);
}

void RecordedLog::countRanges(const common::LaserScan& scan) {
  ranges_ += scan.ranges_m.size();
  nearest_m_ = scan.range_min_m;
  farthest_m_ = scan.range_max_m;
  for (const float range_m : scan.ranges_m) {
    invalid_ += range_m >= scan.range_min_m ? 0 : 1;
    beyond_ += range_m > scan.range_max_m ? 1 : 0;
  }
}

common::Message RecordedLog::whyNoPoints() const {
  using common::Message;
  if (scans_ == 0) return Message("laser-log.no-scans", "no scan in it could be read");
  const std::string scans = plural(scans_, "scan", "scans");
  if (ranges_ == 0)
    return Message("laser-log.no-ranges", "none of its {} has points enough: they have no ranges", scans);
  if (2 * invalid_ >= ranges_)
    return Message("laser-log.no-numbers",
                   "none of its {} has points enough: {} of {} ranges are no number or nearer than the laser's {:g} m",
                   scans, invalid_, ranges_, nearest_m_);
  if (2 * beyond_ >= ranges_)
    return Message(
        "laser-log.ranges-beyond",
        "none of its {} has points enough: {} of {} ranges are beyond the laser's {:g} m; are they in metres?", scans,
        beyond_, ranges_, farthest_m_);
  return Message("laser-log.few-points", "none of its {} has points enough", scans);
}

common::InputError RecordedLog::unusable(std::string_view what) const {
  const std::vector<common::Problem>& problems = reader().counts().first_problems;
  const std::string hint = problems.empty() ? "" : "first problem: " + toString(problems.front());
  return common::InputError({file_}, "", whyNoPoints().behind(what), hint);
}

}  // namespace swiftlet::apps
