#include "interfaces/laser_log/carmen.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Pose2;

constexpr double kPi = std::numbers::pi;
constexpr int kMaxBeams = 20'000;
/// Old lines do not say how far their laser sees: SICK and others write 50, 51.x, 81.8 or 81.9 for "nothing".
constexpr double kOldRangeMax_m = 49.9;
constexpr double kOldRangeMin_m = 0.05;

/// The words of a line one after the other; once one is not what it should be, that is the line's problem.
class Fields {
 public:
  explicit Fields(std::string_view line) : begin_(line.data()), at_(begin_), end_(begin_ + line.size()) {}

  std::string_view word(const char* name) {
    while (at_ != end_ && isBlank(*at_)) ++at_;
    const char* first = at_;
    while (at_ != end_ && !isBlank(*at_)) ++at_;
    if (first == at_) fail(first, name, "the line ends before it");
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  double number(const char* name) {
    const std::string_view text = word(name);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size())
      fail(text.data(), name, fmt::format("`{}` is not a number", text));
    return value;
  }

  double finite(const char* name) {
    const char* before = at_;
    const double value = number(name);
    if (!std::isfinite(value)) fail(before, name, "is not finite");
    return value;
  }

  int count(const char* name) {
    const char* before = at_;
    const double value = number(name);
    if (value >= 0 && value <= kMaxBeams && value == std::floor(value)) return static_cast<int>(value);
    fail(before, name, fmt::format("{} is not a number of readings", value));
    return 0;
  }

  Pose2 pose(const char* name) {
    Pose2 pose;
    pose.x_m = finite(name);
    pose.y_m = finite(name);
    pose.yaw_rad = common::wrapAngle(finite(name));
    return pose;
  }

  common::Time stamp(const char* name) {
    const std::string_view text = word(name);
    const auto stamp = parseStamp(text);
    if (!stamp) fail(text.data(), name, fmt::format("`{}` is not a time in seconds", text));
    return stamp.value_or(common::Time());
  }

  const std::optional<LineProblem>& problem() const { return problem_; }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void fail(const char* where, const char* name, std::string message) {
    if (!problem_) problem_ = LineProblem{static_cast<int>(where - begin_) + 1, name, std::move(message)};
    at_ = end_;
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  std::optional<LineProblem> problem_;
};

void readRanges(Fields& fields, int count, common::LaserScan& scan) {
  scan.ranges_m.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count && !fields.problem(); ++i) {
    const double range_m = fields.number("range");
    scan.ranges_m.push_back(range_m >= 0.0 ? static_cast<float>(range_m) : std::numeric_limits<float>::quiet_NaN());
  }
}

/// FLASER n ranges.. laser pose, robot pose, stamp, host, logger's stamp
void readOldScan(Fields& fields, LoggedScan& logged) {
  common::LaserScan& scan = logged.scan;
  const int beams = fields.count("number of readings");
  readRanges(fields, beams, scan);
  // 180 or 360 beams leave out the last of the half turn, 181 or 361 do not.
  scan.angle_min_rad = -0.5 * kPi;
  scan.angle_increment_rad = beams > 1 ? kPi / (beams % 2 == 0 ? beams : beams - 1) : 0.0;
  scan.range_min_m = kOldRangeMin_m;
  scan.range_max_m = kOldRangeMax_m;
  const Pose2 T_odom_laser = fields.pose("laser pose");
  logged.T_odom_robot = fields.pose("robot pose");
  logged.T_robot_laser = logged.T_odom_robot->inverse() * T_odom_laser;
  scan.stamps.measured = fields.stamp("ipc_timestamp");
}

/// ROBOTLASER1 type start fov resolution max accuracy remission_mode n ranges.. m remissions.. laser pose, robot pose,
/// tv rv forward_safety side_safety turn_axis, stamp, host, logger's stamp
void readNewScan(Fields& fields, LoggedScan& logged) {
  common::LaserScan& scan = logged.scan;
  (void)fields.number("laser_type");
  scan.angle_min_rad = fields.finite("start_angle");
  const double field_of_view_rad = fields.finite("field_of_view");
  scan.angle_increment_rad = fields.finite("angular_resolution");
  scan.range_min_m = kOldRangeMin_m;
  scan.range_max_m = fields.finite("maximum_range");
  if (scan.range_max_m < kOldRangeMin_m) scan.range_max_m = kOldRangeMax_m;  // Not filled in.
  (void)fields.number("accuracy");
  (void)fields.number("remission_mode");
  const int beams = fields.count("number of readings");
  readRanges(fields, beams, scan);
  if (scan.angle_increment_rad <= 0.0 && beams > 1) scan.angle_increment_rad = field_of_view_rad / (beams - 1);
  const int remissions = fields.count("number of remissions");
  for (int i = 0; i < remissions && !fields.problem(); ++i) (void)fields.number("remission");
  const Pose2 T_odom_laser = fields.pose("laser pose");
  logged.T_odom_robot = fields.pose("robot pose");
  logged.T_robot_laser = logged.T_odom_robot->inverse() * T_odom_laser;
  for (const char* name : {"tv", "rv", "forward_safety_dist", "side_safety_dist", "turn_axis"})
    (void)fields.number(name);
  scan.stamps.measured = fields.stamp("ipc_timestamp");
}

void useSensor(const common::LaserConfig& sensor, LoggedScan& logged) {
  common::LaserScan& scan = logged.scan;
  scan.angle_min_rad = sensor.angleMin_rad();
  scan.angle_increment_rad =
      -2.0 * scan.angle_min_rad / std::max<double>(1.0, static_cast<double>(scan.ranges_m.size()) - 1.0);
  scan.range_min_m = sensor.range_min_m;
  scan.range_max_m = sensor.range_max_m;
  logged.T_robot_laser = common::planar(sensor.mount.pose());
}

/// What is as far as the laser sees or farther is no return.
void markNoReturns(common::LaserScan& scan) {
  for (float& range : scan.ranges_m)
    if (range >= static_cast<float>(scan.range_max_m)) range = std::numeric_limits<float>::infinity();
}

}  // namespace

bool isCarmenLine(std::string_view line) {
  for (const std::string_view word :
       {"FLASER ", "RLASER ", "ODOM ", "PARAM ", "SYNC ", "ROBOTLASER", "RAWLASER", "# message", "TRUEPOS", "NMEA"})
    if (line.starts_with(word)) return true;
  return false;
}

tl::expected<std::optional<LoggedScan>, LineProblem> parseCarmenLine(std::string_view line,
                                                                     const LaserLogOptions& options) {
  const bool old_form = line.starts_with("FLASER ");
  if (!old_form && !line.starts_with("ROBOTLASER1 ")) return std::nullopt;
  Fields fields(line);
  (void)fields.word("message");
  LoggedScan logged;
  old_form ? readOldScan(fields, logged) : readNewScan(fields, logged);
  if (fields.problem()) return tl::unexpected(*fields.problem());
  logged.scan.stamps.arrived = logged.scan.stamps.measured;
  if (options.sensor) useSensor(*options.sensor, logged);
  markNoReturns(logged.scan);
  return logged;
}

}  // namespace swiftlet::interfaces
