#pragma once

#include <utility>
#include <vector>

#include "common/trajectory.hpp"
#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::test {

/// Gives scans to a SLAM, and returns the trajectory from its map of all: the final pose of each matched scan, with the
/// stamp of the scan in the log.
class TrackedPath {
 public:
  explicit TrackedPath(perception::LaserSlam& slam) : slam_(slam) {}

  void add(common::Time known_as, const perception::LaserSlamInput& input) {
    if (const auto scan = slam_.add(input)) track_.emplace_back(known_as, *scan);
  }

  /// Call it after the last scan.
  common::Trajectory finish() {
    slam_.finish();
    const std::vector<common::Pose2> keys = slam_.keyPoses();
    std::vector<common::StampedPose> poses;
    for (const auto& [stamp, scan] : track_) poses.push_back({stamp, common::lifted(scan.T_map_robot(keys), 0.0)});
    return common::ordered(std::move(poses)).trajectory;
  }

 private:
  perception::LaserSlam& slam_;
  std::vector<std::pair<common::Time, perception::TrackedScan>> track_;
};

}  // namespace swiftlet::test
