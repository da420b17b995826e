// Which pieces of a track are connected. Each time the laser odometry is lost and restarts, a new piece of the track
// begins, and its pose relative to the piece before is a guess. Loop closures connect pieces, and so does a motion over
// the gap that is known well enough (from wheels). A piece without a connection may be anywhere in the map.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

struct MapJudgement;
struct SlamEdge;
struct FollowedScan;

/// How the pieces that have key scans are connected.
struct TrackConnection {
  std::uint64_t breaks = 0;            ///< Times the track was lost and restarted.
  std::uint64_t bridged = 0;           ///< Breaks over which the motion is known.
  std::uint64_t pieces = 1;            ///< Pieces with key scans of their own.
  std::uint64_t unconnected = 0;       ///< Pieces that nothing connects to the largest group.
  std::uint64_t unconnected_keys = 0;  ///< Key scans of the unconnected pieces.
};

/// Why a map of this many scans is probably wrong; empty when there is no reason. `unmatched` scans matched nothing.
std::string whyNotTrusted(std::uint64_t scans, std::uint64_t unmatched, const TrackConnection& track,
                          const MapJudgement& judgement);

/// Records the pieces of a track, scan by scan. Not thread-safe.
class TrackPieces {
 public:
  /// Takes in the next scan. `keys_before` and `keys_after`: numbers of key scans before and after it was added.
  void add(const FollowedScan& followed, std::uint64_t keys_before, std::uint64_t keys_after);

  /// How the pieces are connected by these edges between `keys` key scans, and by the map. Only loop closures count
  /// among the edges: a local match searches around the predicted pose, which is wrong by more than the search window
  /// once the track is lost. In the map, two pieces are connected when they saw several of the same places and agree in
  /// most.
  TrackConnection connection(std::uint64_t keys, std::span<const SlamEdge> edges, const MapJudgement& judgement) const;

 private:
  struct Break {
    std::uint64_t lost_from = 0;  ///< The first key scan added after the last match.
    std::uint64_t first_key = 0;  ///< The first key scan of the new piece.
    bool bridged = false;
  };

  std::vector<Break> breaks_;
  std::uint64_t matched_keys_ = 0;                            ///< Number of key scans at the last match.
  Eigen::Matrix3d gap_covariance_ = Eigen::Matrix3d::Zero();  ///< Of the motion since the last match.
  std::deque<common::Pose2> last_matches_;                    ///< Each relative to its prediction; the newest last.
};

}  // namespace swiftlet::perception
