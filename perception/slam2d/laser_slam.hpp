// SLAM from a laser that is carried level, and nothing else: a recorded log, a robot on wheels. Odometry is taken as a
// hint where there is some; without, the last step is expected again.
//
//   scan --> LaserFrontEnd --> PlanarSlam --> where the scan stands relative to a key scan
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/slam2d/slam_method.hpp"
#include "perception/slam2d/track_pieces.hpp"

namespace swiftlet::perception {

struct LaserSlamConfig {
  LaserFrontEndConfig front_end;
  SlamMethodConfig slam;
};

/// Where a scan was taken: follows its key scan when that one is corrected.
struct TrackedScan {
  int key = 0;  ///< Into keyPoses().
  common::Pose2 T_key_robot;
  bool matched = false;  ///< False: it stands where it was expected.

  /// Throws std::out_of_range when `keys` are not those of its map.
  common::Pose2 T_map_robot(const std::vector<common::Pose2>& keys) const {
    return keys.at(static_cast<std::size_t>(key)) * T_key_robot;
  }
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
  std::uint64_t keyScans() const;  ///< How many these are.
  common::OccupancyGrid map();
  const PlanarSlam& slam() const;
  const LaserOdometryCounts& odometryCounts() const;
  LaserSlamCounts counts() const;
  /// Which pieces of the track hold together so far. A method without a graph closes no loops that it could know of.
  TrackConnection connection() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
