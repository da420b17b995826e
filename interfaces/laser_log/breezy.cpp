#include "interfaces/laser_log/breezy.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "interfaces/files/text_file.hpp"
#include "interfaces/laser_log/scan_geometry.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;
using common::Pose2;

// Data of the rover: see the format's own reader.
constexpr double kTicksPerTurn = 2000.0;
constexpr double kWheelRadius_m = 0.077;
constexpr double kHalfAxle_m = 0.165;
constexpr double kLaserAhead_m = 0.145;

// Data of the laser: 1,024 steps a turn, 10 turns a second, the beams spread evenly to both sides of straight ahead.
// Readings below 20 mm are error codes.
constexpr double kStep_rad = 2.0 * std::numbers::pi / 1024.0;
constexpr common::Duration kStepTime = common::Duration::fromNanoseconds(100'000'000 / 1024);
constexpr double kRangeMin_m = 0.02;
constexpr double kRangeMax_m = 5.6;
constexpr int kWidestFan = 769;  ///< Beams over 270 degrees.

constexpr int kFirstColumns = 4;   ///< Time, one unused column, ticks of both wheels.
constexpr int kOtherColumns = 20;  ///< Columns between the ticks and the ranges.
constexpr double kMostTicks = 2147483648.0;
constexpr double kFarthestStamp_us = 1e6 * common::kFarthestStamp_s;
constexpr int kBreezySurveyedLines = 1000;

/// Pose of the rover by its wheels.
class WheelOdometry {
 public:
  Pose2 at(double left_ticks, double right_ticks) {
    if (begun_) {
      const double left_m = metres(left_ticks - left_ticks_), right_m = metres(right_ticks - right_ticks_);
      const double ahead_m = 0.5 * (left_m + right_m), turn_rad = (right_m - left_m) / (2.0 * kHalfAxle_m);
      // The chord of the arc.
      const double half_rad = 0.5 * turn_rad;
      const double chord_m = std::abs(half_rad) < 1e-6 ? ahead_m : ahead_m * std::sin(half_rad) / half_rad;
      T_odom_robot_ = T_odom_robot_ * Pose2{chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), turn_rad};
    }
    begun_ = true;
    left_ticks_ = left_ticks;
    right_ticks_ = right_ticks;
    return T_odom_robot_;
  }

 private:
  static double metres(double ticks) { return ticks / kTicksPerTurn * 2.0 * std::numbers::pi * kWheelRadius_m; }
  bool begun_ = false;
  double left_ticks_ = 0.0, right_ticks_ = 0.0;
  Pose2 T_odom_robot_;
};

class BreezyFormat final : public LogFormat {
 public:
  BreezyFormat(int beams, const LaserLogOptions& options) : beams_(beams), options_(options) {}

  tl::expected<std::optional<LoggedScan>, RecordProblem> parse(std::string_view line) override {
    LogFields fields(line);
    if (fields.atEnd()) return std::nullopt;
    const double time_us = within(fields, "time", kFarthestStamp_us);
    (void)fields.finite("column");
    const double left_ticks = within(fields, "left wheel", kMostTicks);
    const double right_ticks = within(fields, "right wheel", kMostTicks);
    for (int i = 0; i < kOtherColumns; ++i) (void)fields.finite("column");
    LoggedScan logged;
    readRanges(fields, logged.scan);
    if (fields.problem()) return tl::unexpected(*fields.problem());
    logged.scan.stamps.measured = common::Time::fromNanoseconds(std::llround(time_us) * 1000);
    logged.scan.stamps.arrived = logged.scan.stamps.measured;
    logged.T_robot_laser = {kLaserAhead_m, 0.0, 0.0};
    if (auto problem = completeScan(options_.sensor, logged)) return tl::unexpected(RecordProblem{1, "", *problem});
    logged.T_odom_robot = odometry_.at(left_ticks, right_ticks);
    return logged;
  }

  std::string name() const override { return "BreezySLAM .dat"; }
  bool hasMicroseconds() const override { return true; }

 private:
  static double within(LogFields& fields, const char* name, double limit) {
    const double value = fields.finite(name);
    if (std::abs(value) <= limit) return value;
    fields.fail(name, Message("laser-log.out-of-bounds", "is out of all bounds"));
    return 0.0;
  }

  void readRanges(LogFields& fields, common::LaserScan& scan) const {
    while (!fields.atEnd() && !fields.problem()) {
      if (scan.ranges_m.size() >= kMaxBeams)
        return fields.fail("range", Message("laser-log.too-many-beams", "there are more than any laser has"));
      fields.ranges(1, 1e-3, scan);
    }
    const int beams = static_cast<int>(scan.ranges_m.size());
    if (!fields.problem() && (beams < 2 || (beams > kWidestFan && !options_.sensor)))
      return fields.fail("range", beams < 2
                                      ? Message("laser-log.line-ends", "the line ends before it")
                                      : Message("laser-log.wider-than-laser", "there are more than a URG-04LX has"));
    // A cut line would spread its beams in wrong directions.
    if (!fields.problem() && beams != beams_)
      return fields.fail("range", Message("laser-log.other-beams", "there are {}, in most lines {}", beams, beams_));
    scan.angle_min_rad = -0.5 * kStep_rad * (beams - 1);
    scan.angle_increment_rad = kStep_rad;
    scan.time_increment = kStepTime;
    scan.range_min_m = kRangeMin_m;
    scan.range_max_m = kRangeMax_m;
  }

  int beams_;
  LaserLogOptions options_;
  WheelOdometry odometry_;
};

/// The number of ranges in most of the first records. If as many are shorter, the longer ones decide: a line is cut
/// more often than it grows. Lines that cannot be read are reported later, when the log is read.
int surveyedBeams(const std::filesystem::path& file) {
  std::map<int, int> lines_by_beams;
  try {
    LineReader reader(file, kLogLimits);
    std::string_view line;
    for (int i = 0; i < kBreezySurveyedLines && reader.next(line); ++i)
      if (isBreezyLine(line)) ++lines_by_beams[static_cast<int>(wordsOf(line).size()) - kFirstColumns - kOtherColumns];
  } catch (const common::InputError&) {}
  int beams = 0, most_lines = 0;
  for (const auto& [count, lines] : lines_by_beams)
    if (lines >= most_lines) {
      beams = count;
      most_lines = lines;
    }
  return beams;
}

}  // namespace

bool isBreezyLine(std::string_view line) {
  constexpr std::size_t kColumns = kFirstColumns + kOtherColumns + 2;
  const std::vector<Word> words = wordsOf(line);
  if (words.size() < kColumns) return false;
  double value = 0.0;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!parseNumber(words[i].text, value) || (i < kFirstColumns && value != std::floor(value))) return false;
  return true;
}

std::unique_ptr<LogFormat> breezyFormat(const std::filesystem::path& file, const LaserLogOptions& options) {
  return std::make_unique<BreezyFormat>(surveyedBeams(file), options);
}

}  // namespace swiftlet::interfaces
