// SLAM with a laser that is carried level: for a recorded log or a wheeled robot. Needs no other sensor. Odometry is
// used as a hint if the input has it; without it, the last motion is assumed to continue.
//
//   scan --> LaserFrontEnd --> PlanarSlam --> pose of the scan relative to a key scan
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/slam2d/map_judgement.hpp"
#include "perception/slam2d/slam_method.hpp"
#include "perception/slam2d/track_pieces.hpp"

namespace swiftlet::perception {

struct LaserSlamConfig {
  LaserFrontEndConfig front_end;
  SlamMethodConfig slam;
};

/// The pose of a scan. It is relative to a key scan, so that it follows when the key scan is corrected.
struct TrackedScan {
  int key = 0;  ///< Index into keyPoses().
  common::Pose2 T_key_robot;
  bool matched = false;  ///< False: the pose is the predicted one.

  /// The pose in the map, for the key poses `keys`. Throws std::out_of_range when `keys` has no entry for `key`.
  common::Pose2 T_map_robot(const std::vector<common::Pose2>& keys) const {
    return keys.at(static_cast<std::size_t>(key)) * T_key_robot;
  }
};

/// Not thread-safe. Deterministic.
class LaserSlam {
 public:
  explicit LaserSlam(const LaserSlamConfig& config);
  ~LaserSlam();

  /// Takes in one scan. Returns nothing until a first scan has had enough points to start the map.
  std::optional<TrackedScan> add(const LaserSlamInput& input);

  /// Call when no more scans come. Runs the last task of the method, if it has one; the poses are final afterwards.
  void finish();

  /// T_map_robot of every key scan, by the current estimate.
  std::vector<common::Pose2> keyPoses() const;
  std::uint64_t keyScans() const;  ///< Number of key scans.
  common::OccupancyGrid map();
  const PlanarSlam& slam() const;
  const LaserOdometryCounts& odometryCounts() const;
  LaserSlamCounts counts() const;
  /// What the map says of itself, as it is now.
  MapJudgement judgement() const;
  /// Which pieces of the track are connected so far: by loop closures, which only a graph has, or because the map shows
  /// the same place in both.
  TrackConnection connection(const MapJudgement& judgement) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
