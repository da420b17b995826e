#include "interfaces/laser_log/carmen.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "interfaces/laser_log/mount_survey.hpp"
#include "interfaces/laser_log/scan_geometry.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;
using common::Pose2;

/// Old lines do not give the range of their laser: SICK and others write 50, 51.x, 81.8 or 81.9 for "nothing".
constexpr double kOldRangeMax_m = 49.9;
constexpr double kOldRangeMin_m = 0.05;
/// The first records are searched within this many lines.
constexpr int kCarmenSurveyedLines = 100'000;

/// The words at the end of every record. A wrong count of readings is detected here at the latest. All words are
/// required, so that a cut line is detected too: a cut stamp alone may only have lost digits.
void readStamps(LogFields& fields, common::LaserScan& scan) {
  scan.stamps.measured = fields.stamp("ipc_timestamp");
  (void)fields.word("ipc_hostname");
  (void)fields.number("logger_timestamp");
  if (!fields.atEnd())
    fields.fail("logger_timestamp",
                Message("laser-log.line-goes-on", "the line goes on after it, is a number of readings wrong?"));
}

/// FLASER n ranges.. laser pose, robot pose, stamp, host, logger's stamp
void readOldScan(LogFields& fields, CarmenScan& logged) {
  common::LaserScan& scan = logged.scan;
  const int beams = fields.count("number of readings");
  fields.ranges(beams, 1.0, scan);
  // 180 or 360 beams omit the last one of the half turn; 181 or 361 include it.
  scan.angle_min_rad = -0.5 * std::numbers::pi;
  scan.angle_increment_rad = beams > 1 ? std::numbers::pi / (beams % 2 == 0 ? beams : beams - 1) : 0.0;
  scan.range_min_m = kOldRangeMin_m;
  scan.range_max_m = kOldRangeMax_m;
  logged.T_odom_laser = fields.pose("laser pose");
  logged.T_odom_robot = fields.pose("robot pose");
  readStamps(fields, scan);
}

/// ROBOTLASER1 type start fov resolution max accuracy remission_mode n ranges.. m remissions.. laser pose, robot pose,
/// tv rv forward_safety side_safety turn_axis, stamp, host, logger's stamp
void readNewScan(LogFields& fields, CarmenScan& logged) {
  common::LaserScan& scan = logged.scan;
  (void)fields.number("laser_type");
  scan.angle_min_rad = fields.finite("start_angle");
  const double field_of_view_rad = fields.finite("field_of_view");
  scan.angle_increment_rad = fields.finite("angular_resolution");
  scan.range_min_m = kOldRangeMin_m;
  scan.range_max_m = fields.finite("maximum_range");
  if (scan.range_max_m <= kOldRangeMin_m) scan.range_max_m = kOldRangeMax_m;  // The field was not filled in.
  (void)fields.number("accuracy");
  (void)fields.number("remission_mode");
  const int beams = fields.count("number of readings");
  fields.ranges(beams, 1.0, scan);
  if (scan.angle_increment_rad <= 0.0 && beams > 1) scan.angle_increment_rad = field_of_view_rad / (beams - 1);
  const int remissions = fields.count("number of remissions");
  for (int i = 0; i < remissions && !fields.problem(); ++i) (void)fields.number("remission");
  logged.T_odom_laser = fields.pose("laser pose");
  logged.T_odom_robot = fields.pose("robot pose");
  for (const char* name : {"tv", "rv", "forward_safety_dist", "side_safety_dist", "turn_axis"})
    (void)fields.number(name);
  readStamps(fields, scan);
}

/// The name of a message with one letter wrong. The first and the last letter may distinguish lasers (RLASER,
/// ROBOTLASER2).
bool isAlmost(std::string_view name, std::string_view message) {
  if (name.size() != message.size() || name.front() != message.front() || name.back() != message.back()) return false;
  return std::inner_product(name.begin(), name.end(), message.begin(), 0, std::plus<>(), std::not_equal_to<>()) == 1;
}

/// The mount from the first records. Lines that cannot be read are reported later, when the log is read.
LaserMount surveyedMount(const std::filesystem::path& file) {
  MountSurvey survey;
  try {
    LineReader reader(file, kLogLimits);
    std::string_view line;
    for (int i = 0; i < kCarmenSurveyedLines && !survey.decided() && reader.next(line); ++i)
      if (const auto scan = parseCarmenLine(line); scan && *scan)
        survey.add((*scan)->T_odom_laser, (*scan)->T_odom_robot);
  } catch (const common::InputError&) {}
  return survey.result();
}

class CarmenFormat final : public LogFormat {
 public:
  CarmenFormat(LaserMount mount, const LaserLogOptions& options) : mount_(mount), options_(options) {}

  tl::expected<std::optional<LoggedScan>, RecordProblem> parse(std::string_view line) override {
    auto read = parseCarmenLine(line);
    if (!read) return tl::unexpected(std::move(read.error()));
    if (!*read && isGarbledCarmenLine(line))
      return tl::unexpected(
          RecordProblem{1, "", Message("laser-log.not-carmen", "is no message of CARMEN, is the log damaged?")});
    if (!*read) return std::nullopt;
    const Pose2 T_odom_laser = (*read)->T_odom_laser, T_odom_robot = (*read)->T_odom_robot;
    if (mount_.rigid && !agrees(T_odom_robot.inverse() * T_odom_laser, mount_)) ++elsewhere_;
    LoggedScan logged{std::move((*read)->scan), mount_.T_robot_laser,
                      mount_.robot_stands ? T_odom_laser : T_odom_robot};
    if (auto problem = completeScan(options_.sensor, logged)) return tl::unexpected(RecordProblem{1, "", *problem});
    return logged;
  }

  std::string name() const override { return "CARMEN"; }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    if (options_.sensor) return notes;
    if (!mount_.rigid)
      notes.emplace_back(
          "the poses of laser and robot keep no distance: the laser is taken to be in the robot's centre");
    if (mount_.robot_stands) notes.emplace_back("the robot's pose never changes: that of the laser is the odometry");
    if (elsewhere_ > 0)
      notes.push_back(
          fmt::format("{} of the records have the laser elsewhere on the robot than the first ones have: "
                      "not believed",
                      elsewhere_));
    return notes;
  }

 private:
  LaserMount mount_;
  LaserLogOptions options_;
  std::uint64_t elsewhere_ = 0;
};

}  // namespace

bool isCarmenLine(std::string_view line) {
  for (const std::string_view word :
       {"FLASER ", "RLASER ", "ODOM ", "PARAM ", "SYNC ", "ROBOTLASER", "RAWLASER", "# message", "TRUEPOS", "NMEA"})
    if (line.starts_with(word)) return true;
  return false;
}

tl::expected<std::optional<CarmenScan>, RecordProblem> parseCarmenLine(std::string_view line) {
  const bool old_form = line.starts_with("FLASER ");
  if (!old_form && !line.starts_with("ROBOTLASER1 ")) return std::nullopt;
  LogFields fields(line);
  (void)fields.word("message");
  CarmenScan logged;
  old_form ? readOldScan(fields, logged) : readNewScan(fields, logged);
  if (fields.problem()) return tl::unexpected(*fields.problem());
  logged.scan.stamps.arrived = logged.scan.stamps.measured;
  return logged;
}

bool isGarbledCarmenLine(std::string_view line) {
  const std::string_view text = line.substr(0, line.find_last_not_of(" \t\r") + 1);
  if (text.empty() || text.front() == '#') return false;
  if (std::any_of(text.begin(), text.end(), [](char c) { return (c < ' ' && c != '\t') || c > '~'; })) return true;
  const std::string_view name = text.substr(0, text.find_first_of(" \t"));
  const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (name.empty() || !isUpper(name.front()) ||
      !std::all_of(name.begin(), name.end(), [&](char c) { return isUpper(c) || (c >= '0' && c <= '9') || c == '_'; }))
    return true;
  return isAlmost(name, "FLASER") || isAlmost(name, "ROBOTLASER1");
}

std::unique_ptr<LogFormat> carmenFormat(const std::filesystem::path& file, const LaserLogOptions& options) {
  return std::make_unique<CarmenFormat>(surveyedMount(file), options);
}

}  // namespace swiftlet::interfaces
