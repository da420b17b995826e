// What every method of 2D SLAM offers: scans go in with the pose that the odometry has of them, out come the correction
// of the odometry, the key scans and the map. slam_method.hpp makes the one that a profile names.
//
//   addScan --> takeTask() --> run(task) on any thread --> apply(result)     (a method without heavy work has no tasks)
//
// Frames: the poses given are T_odom_body, continuous. The map frame begins where odom does, at the first scan;
// T_map_odom jumps when the method corrects the odometry.
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
#include "perception/slam2d/slam_edge.hpp"
#include "perception/slam2d/slam_task.hpp"

namespace swiftlet::perception {

/// How a method works; see the header of each.
enum class SlamMethod {
  kGraph,      ///< Slam2d: a graph of key scans with loop closures (Grzonka 2009, section V-D).
  kParticles,  ///< ParticleSlam: particles with a map each (Bachrach 2009, section 5.3).
  kScanToMap,  ///< ScanToMapSlam: scans matched to one map (Saeedi, section III-B).
};

/// What adding a scan did.
struct SlamUpdate {
  bool key_scan = false;     ///< It became a key scan; older ones may have moved.
  bool drawn = false;        ///< The map changed.
  common::Pose2 T_map_body;  ///< Of the scan, corrected.
};

struct SlamCounts {
  std::uint64_t scans = 0;
  std::uint64_t ignored_scans = 0;  ///< Out of order, or without a finite pose.
  std::uint64_t key_scans = 0;
  /// Matches of a scan to what the method keeps of those before; each method counts its own alone.
  std::uint64_t graph_matches = 0;     ///< To key scans of the graph.
  std::uint64_t particle_matches = 0;  ///< To the map of a particle; each scan to all of them.
  std::uint64_t map_matches = 0;       ///< To the one map.
  std::uint64_t local_failures = 0;    ///< Scans that should have matched older ones, but did not.
  std::uint64_t loop_candidates = 0;
  std::uint64_t loops_closed = 0;
  std::uint64_t loops_rejected = 0;  ///< Of those, closures that later ones contradicted.
  std::uint64_t resamplings = 0;     ///< Of the particles.
};

/// Single-threaded, and deterministic: the same calls give the same bytes. The values it hands out are safe anywhere.
class PlanarSlam {
 public:
  struct KeyPose {
    common::Time stamp;
    common::Pose2 T_map_body;
  };

  virtual ~PlanarSlam() = default;

  virtual SlamMethod method() const = 0;

  /// `T_odom_body`: the filter's pose at the scan's stamp. `covariance_since_last`: of the motion since the last scan
  /// given here, of the additive errors (x_m, y_m, yaw_rad) in the body frame of that last scan.
  virtual SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                             const Eigen::Matrix3d& covariance_since_last) = 0;

  /// Takes odom to map.
  virtual common::Pose2 T_map_odom() const = 0;
  /// The key scan (of keyPoses()) that the last scan is known by, and where it stands relative to it; -1 before the
  /// first.
  virtual int anchor() const = 0;
  virtual common::Pose2 T_anchor_body() const = 0;
  /// Every key scan at its best pose so far.
  virtual std::vector<KeyPose> keyPoses() const = 0;

  /// The height over the take-off floor that the map shall be of; at first that of the body in the first scan.
  /// True when the map is another one now.
  virtual bool setFlightHeight(double height_m) = 0;
  /// What may touch the hull at flight height, as known now; tiles are shared, cheap.
  virtual common::OccupancyGrid snapshot() = 0;

  virtual const SlamCounts& counts() const = 0;

  /// Whether key scans are held by constraints, which edges() gives, and loops are closed by them.
  virtual bool hasGraph() const { return false; }
  /// The constraints, as indices into keyPoses(). Valid until the next call that is not const.
  virtual std::span<const SlamEdge> edges() const { return {}; }

  /// Heavy work, when there is any and none is outstanding.
  [[nodiscard]] virtual std::optional<SlamTask> takeTask() { return std::nullopt; }
  /// The last work, when no more scans come. None may be outstanding.
  [[nodiscard]] virtual std::optional<SlamTask> takeLastTask() { return std::nullopt; }
  /// Takes the result of the outstanding task; true when T_map_odom or the map changed.
  virtual bool apply(const SlamResult& /*result*/) { return false; }
};

}  // namespace swiftlet::perception
