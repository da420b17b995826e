// Recorded logs of a 2D laser, scan by scan, in any of three formats: CARMEN text, BreezySLAM .dat, rosbag 1. A log is
// streamed: the memory used does not grow with its length.
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

/// One scan of the log.
struct LoggedScan {
  /// `stamps` are the log's own, of the first beam in time: they may repeat and go back. The measured and the arrived
  /// stamp are equal. The time between two beams is negative where the last beam was the first in time.
  common::LaserScan scan;
  common::Pose2 T_robot_laser;
  std::optional<common::Pose2> T_odom_robot;  ///< The robot's own odometry; nullopt if the log has no odometry.
};

struct LaserLogOptions {
  /// The laser's geometry, to use if that of the log is wrong or unknown: field of view, ranges and mount. The number
  /// of beams is always the scan's own; the field of view is spread over them.
  std::optional<common::LaserConfig> sensor;
};

struct LaserLogCounts {
  std::uint64_t scans = 0;
  std::uint64_t skipped_records = 0;            ///< Number of records that could not be read.
  std::vector<common::Problem> first_problems;  ///< The reasons of the first few skipped records.
  std::uint64_t invalid_ranges = 0;             ///< NaN or negative ranges in scans that were otherwise read.
  static constexpr std::size_t kProblemsKept = 5;
};

/// One thread at a time.
class LaserLog {
 public:
  virtual ~LaserLog() = default;

  /// The next scan that can be read; nullopt at the end. A record that cannot be read is skipped and counted. Throws
  /// InputError with file and line if the file itself cannot be read on (a damaged archive).
  [[nodiscard]] virtual std::optional<LoggedScan> next() = 0;
  virtual const LaserLogCounts& counts() const = 0;
  /// Share of the file that has been read, in [0, 1].
  virtual double progress() const = 0;
  /// The format that was recognized, for people: "rosbag, /scan".
  virtual std::string format() const = 0;
  /// Whether its stamps are microseconds, and not seconds.
  virtual bool hasMicroseconds() const { return false; }
  /// Oddities of the log so far, and how they were handled, for people.
  virtual std::vector<std::string> notes() const = 0;
};

}  // namespace swiftlet::interfaces
