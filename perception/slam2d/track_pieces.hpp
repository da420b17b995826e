// Which pieces of a track hold together. Each time the laser odometry is lost and starts anew, a new piece of the track
// begins, and where it stands relative to the one before is a guess. Loop closures connect pieces, and so does a motion
// over the gap that is known well enough (wheels). A piece that nothing connects may stand anywhere in the map.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::perception {

struct SlamEdge;
struct FollowedScan;

/// How certain the motion over a gap must be to connect what lies before and after it.
struct BridgeConfig {
  /// As certain as the local match asks for that follows it (Slam2dConfig::local_sigma_m).
  double max_sigma_m = 0.10;
  double max_sigma_deg = 3.0;
};

/// What holds together, among the pieces that have key scans.
struct TrackConnection {
  std::uint64_t breaks = 0;            ///< Times the track was lost and begun anew.
  std::uint64_t bridged = 0;           ///< Of these, gaps over which the motion is known.
  std::uint64_t pieces = 1;            ///< With key scans of their own.
  std::uint64_t unconnected = 0;       ///< Of these, pieces that nothing connects to the largest group.
  std::uint64_t unconnected_keys = 0;  ///< Key scans of those.
};

/// Why a map made of so many scans is probably wrong; empty when nothing says so. `unmatched` scans matched nothing.
std::string whyNotTrusted(std::uint64_t scans, std::uint64_t unmatched, const TrackConnection& track);

/// Follows a track scan by scan. Not thread-safe.
class TrackPieces {
 public:
  explicit TrackPieces(const BridgeConfig& config = {}) : config_(config) {}

  /// The next scan; `keys_before` and `keys_after` are how many key scans there were before and after it was added.
  void add(const FollowedScan& followed, std::uint64_t keys_before, std::uint64_t keys_after);

  /// What holds together with these edges between `keys` key scans. Of the edges only loop closures count: a match
  /// to what lay around the last pose seeks no farther than that pose is uncertain only as long as it is not lost.
  TrackConnection connection(std::uint64_t keys, std::span<const SlamEdge> edges) const;

 private:
  struct Break {
    std::uint64_t lost_from = 0;  ///< Key scans from this one on are later than the last scan that matched.
    std::uint64_t first_key = 0;  ///< Key scans from this one on belong to the new piece.
    bool bridged = false;
  };

  BridgeConfig config_;
  std::vector<Break> breaks_;
  std::uint64_t matched_keys_ = 0;                            ///< How many there were at the last match.
  Eigen::Matrix3d gap_covariance_ = Eigen::Matrix3d::Zero();  ///< Of the motion since the last match.
};

}  // namespace swiftlet::perception
