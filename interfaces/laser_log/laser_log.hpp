// Recorded logs of a 2D laser, scan by scan, whatever format they are in: CARMEN text, BreezySLAM .dat, rosbag 1.
// A log is streamed: what is held does not grow with its length.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::interfaces {

/// One scan as the log has it.
struct LoggedScan {
  /// `stamps` are the log's own: they may repeat, and go back. Both are the same.
  common::LaserScan scan;
  common::Pose2 T_robot_laser;
  std::optional<common::Pose2> T_odom_robot;  ///< By the robot's own odometry; none where the log has none.
};

struct LaserLogOptions {
  /// The laser's geometry, where the log's is wrong or unknown: field of view, ranges and mount. The number of beams is
  /// always the scan's own; the field of view is spread over it.
  std::optional<common::LaserConfig> sensor;
};

struct LaserLogCounts {
  std::uint64_t scans = 0;
  std::uint64_t skipped_records = 0;            ///< Records that could not be read,
  std::vector<common::Problem> first_problems;  ///< and why, for the first few.
  std::uint64_t invalid_ranges = 0;             ///< NaN or negative, of scans that were read otherwise.
  static constexpr std::size_t kProblemsKept = 5;
};

/// One thread at a time.
class LaserLog {
 public:
  virtual ~LaserLog() = default;

  /// The next scan that can be read; none at the end. A record that cannot be read is skipped and counted. Throws
  /// InputError where the file itself cannot be read on (a damaged archive), with file and line.
  [[nodiscard]] virtual std::optional<LoggedScan> next() = 0;
  virtual const LaserLogCounts& counts() const = 0;
  /// Share of the file that has been read, in [0, 1].
  virtual double progress() const = 0;
  /// What was recognized, for people: "rosbag, /scan".
  virtual std::string format() const = 0;
  /// What is odd about the log as far as it was read, and how it was taken, for people.
  virtual std::vector<std::string> notes() const = 0;
};

}  // namespace swiftlet::interfaces
