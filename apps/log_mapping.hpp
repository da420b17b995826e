// The map of a recorded laser log: SLAM over its scans, their track, and what the finished map says of itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/spool.hpp"
#include "common/time.hpp"
#include "common/trajectory.hpp"
#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::apps {

/// A scan of the log, with the log's own stamp.
struct StampedScan {
  common::Time stamp;
  perception::TrackedScan scan;
};
using TrackSpool = Spool<StampedScan>;

/// Whether a map can be trusted, and why, or why not.
struct Trust {
  bool trusted = false;
  std::string reason;
};

/// One thread at a time. Call finish() after the last scan; what follows it is of the finished map.
struct LogMapping {
  explicit LogMapping(const perception::LaserSlamConfig& config) : slam(config) {}

  /// The track knows the scan by `known_as`. Returns nullopt until a first scan has had enough points.
  std::optional<perception::TrackedScan> add(common::Time known_as, const perception::LaserSlamInput& input);
  void finish();

  /// `why_bent`: why the scans themselves are bent; empty if they are not.
  Trust trust(const std::string& why_bent) const;
  /// Length of the robot's path. A standing robot adds nothing.
  double pathLength_m() const;
  /// Of scans known by the same stamp, the last.
  common::Trajectory trajectory() const;

  perception::LaserSlam slam;
  TrackSpool track;
  std::uint64_t scans = 0, unmatched = 0;
  perception::MapJudgement judgement;
  perception::TrackConnection connection;
};

}  // namespace swiftlet::apps
