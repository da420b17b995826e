// The interface of every method of 2D SLAM. Scans go in with their poses by odometry. The correction of the odometry,
// the key scans and the map come out. slam_method.hpp creates the method that a profile names.
//
//   addScan --> takeTask() --> run(task) on any thread --> apply(result)     (a method without heavy work has no tasks)
//
// Frames: the poses given are T_odom_body, which is continuous. The map frame equals odom at the first scan. T_map_odom
// jumps when the method corrects the odometry.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/columns.hpp"
#include "perception/slam2d/slam_edge.hpp"
#include "perception/slam2d/slam_task.hpp"

namespace swiftlet::perception {

/// The methods; the header of each explains how it works.
enum class SlamMethod {
  kGraph,      ///< Slam2d: a graph of key scans with loop closures (Grzonka 2009, section V-D).
  kParticles,  ///< ParticleSlam: particles with a map each (Bachrach 2009, section 5.3).
  kScanToMap,  ///< ScanToMapSlam: scans matched to one map (Saeedi, section III-B).
};

/// What adding a scan did.
struct SlamUpdate {
  bool key_scan = false;     ///< The scan became a key scan; older ones may have moved.
  bool drawn = false;        ///< The map changed.
  common::Pose2 T_map_body;  ///< The corrected pose of the scan.
  /// Newest of the key scans of an earlier pass, if the scan was matched in every direction to these alone; else -1.
  /// The scan is then as uncertain relative to the first one as that key scan is.
  int known_key = -1;
  std::vector<GoneColumn> gone = {};  ///< What has gone from the map with this scan.
};

struct SlamCounts {
  std::uint64_t scans = 0;
  /// Scans that were out of order or without a finite pose, or had too few points to start the map.
  std::uint64_t ignored_scans = 0;
  std::uint64_t key_scans = 0;
  // Each method counts only its own kind of matches.
  std::uint64_t graph_matches = 0;     ///< Matches of a scan to key scans of the graph.
  std::uint64_t particle_matches = 0;  ///< Matches of a scan to the map of one particle.
  std::uint64_t map_matches = 0;       ///< Matches of a scan to the one map.
  std::uint64_t local_failures = 0;    ///< Scans that should have matched older ones, but did not.
  std::uint64_t loop_candidates = 0;
  std::uint64_t loops_closed = 0;
  std::uint64_t loops_rejected = 0;  ///< Edges removed from the graph, since later closures contradict them.
  std::uint64_t resamplings = 0;     ///< Times the particles were resampled.
};

/// Not thread-safe. Deterministic: the same calls give the same bytes. Tasks and snapshots may be used on any thread.
class PlanarSlam {
 public:
  struct KeyPose {
    common::Time stamp;
    common::Pose2 T_map_body;
  };

  virtual ~PlanarSlam() = default;

  virtual SlamMethod method() const = 0;

  /// Takes in one scan. `T_odom_body`: the pose by odometry at the scan's stamp. `covariance_since_last`: covariance of
  /// the motion since the previous scan given here, of the additive errors (x_m, y_m, yaw_rad) in the body frame of
  /// that scan.
  virtual SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                             const Eigen::Matrix3d& covariance_since_last) = 0;

  /// The correction of the odometry; takes coordinates in odom to map.
  virtual common::Pose2 T_map_odom() const = 0;
  /// The key scan, as an index into keyPoses(), to which the pose of the last scan is relative; -1 before the first
  /// scan.
  virtual int anchor() const = 0;
  /// The pose of the last scan relative to its anchor.
  virtual common::Pose2 T_anchor_body() const = 0;
  /// Every key scan at its best pose so far.
  virtual std::vector<KeyPose> keyPoses() const = 0;

  /// Sets the height above the take-off floor for which the map is made. The initial one is the body's height in the
  /// first scan. Returns true when the map has changed.
  virtual bool setFlightHeight(double height_m) = 0;
  /// What may touch the hull at flight height, as known now. Shares its tiles with the method's own map.
  virtual common::OccupancyGrid snapshot() = 0;

  virtual const SlamCounts& counts() const = 0;

  /// The constraints of the pose graph, with indices into keyPoses(); only SlamMethod::kGraph has one. Valid until the
  /// next call that is not const.
  virtual std::span<const SlamEdge> edges() const { return {}; }

  /// Heavy work, if there is any and no task is outstanding.
  [[nodiscard]] virtual std::optional<SlamTask> takeTask() { return std::nullopt; }
  /// The last tasks, to be taken one after the other when no more scans come, until it returns nullopt. No task may be
  /// outstanding.
  [[nodiscard]] virtual std::optional<SlamTask> takeLastTask() { return std::nullopt; }
  /// Applies the result of the outstanding task. Returns true when T_map_odom or the map has changed.
  virtual bool apply(const SlamResult& /*result*/) { return false; }
};

}  // namespace swiftlet::perception
