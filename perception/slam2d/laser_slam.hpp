// SLAM from a laser that is carried level, and nothing else: a recorded log, a robot on wheels. Odometry is taken as a
// hint where there is some; without, the last step is expected again.
//
//   scan --> predict --> LaserOdometry --> Slam2d --> where the scan stands relative to a key scan
//
// The stamps of logs can be doubtful; ScanClock makes of them a time that grows.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "perception/scan_matching/laser_odometry.hpp"
#include "perception/slam2d/motion_prediction.hpp"
#include "perception/slam2d/slam2d.hpp"

namespace swiftlet::perception {

struct LaserSlamConfig {
  LaserSlamConfig();

  LaserOdometryConfig odometry;
  Slam2dConfig slam;
  MotionPredictionConfig motion;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct LaserSlamInput {
  const common::LaserScan& scan;  ///< Its stamp is the log's.
  common::Pose2 T_robot_laser;
  std::optional<common::Pose2> T_odom_robot;
};

/// Where a scan was taken: follows its key scan when that one is corrected.
struct TrackedScan {
  int key = 0;  ///< Into keyPoses().
  common::Pose2 T_key_robot;
  bool matched = false;  ///< False: it stands where it was expected.
};

struct LaserSlamCounts {
  std::uint64_t doubtful_stamps = 0;    ///< Not after the one before.
  std::uint64_t doubtful_odometry = 0;  ///< Steps of the odometry that no robot makes.
  std::uint64_t empty_scans = 0;        ///< Too few points to begin with.
};

/// Not thread-safe. Deterministic.
class LaserSlam {
 public:
  explicit LaserSlam(const LaserSlamConfig& config);
  ~LaserSlam();

  /// None as long as no scan has had enough points to begin with.
  std::optional<TrackedScan> add(const LaserSlamInput& input);

  /// When no more scans come: the best poses there are.
  void finish();

  /// T_map_robot of every key scan, at its best so far.
  std::vector<common::Pose2> keyPoses() const;
  common::OccupancyGrid map();
  const Slam2d& slam() const;
  const LaserOdometryCounts& odometryCounts() const;
  const LaserSlamCounts& counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
