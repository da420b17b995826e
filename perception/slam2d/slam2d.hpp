// Graph SLAM in the plane (Grzonka 2009, section V-D): key scans are nodes, matches are edges, loops are sought where
// the projected uncertainty allows, and the map is an occupancy grid drawn from the scans at their best poses.
//
// In flight each scan costs a fraction of a millisecond: a key scan is matched to the older key scans around it, which
// bounds the drift inside known area, and drawn into the grid. What is heavy (loop search, optimization, drawing the
// grid anew) is a value: `takeTask` hands it out, `run` computes it anywhere, `apply` takes the result in.
//
//   addScan --> key scan --> takeTask() --> run(task) on any thread --> apply(result)
//
// Frames: the poses given are T_odom_body, continuous. The map frame is that of the grid; T_map_odom jumps with a local
// correction (millimetres, at a key scan) and with a loop closure (apply).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_edge.hpp"
#include "perception/slam2d/slam_task.hpp"

namespace swiftlet::perception {

/// What adding a scan did.
struct SlamUpdate {
  bool key_scan = false;     ///< It became a node of the graph.
  bool drawn = false;        ///< The grid changed.
  common::Pose2 T_map_body;  ///< Of the scan, corrected.
};

struct SlamCounts {
  std::uint64_t scans = 0;
  std::uint64_t ignored_scans = 0;  ///< Out of order, or without a finite pose.
  std::uint64_t key_scans = 0;
  std::uint64_t local_failures = 0;  ///< Scans that should have matched older ones, but did not.
  std::uint64_t loop_candidates = 0;
  std::uint64_t loops_closed = 0;
  std::uint64_t loops_rejected = 0;  ///< Of those, closures that later ones contradicted.
};

/// Single-threaded; the values it hands out are safe anywhere.
class Slam2d {
 public:
  explicit Slam2d(const Slam2dConfig& config);
  ~Slam2d();
  Slam2d(Slam2d&&) noexcept;
  Slam2d& operator=(Slam2d&&) noexcept;

  /// `T_odom_body`: the filter's pose at the scan's stamp. `covariance_since_last`: of the motion since the last scan
  /// given here, of the additive errors (x_m, y_m, yaw_rad) in the body frame of that last scan.
  SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                     const Eigen::Matrix3d& covariance_since_last);

  /// Takes odom to map.
  common::Pose2 T_map_odom() const;
  /// The key scan (of keyPoses()) that the last scan is known by, and where it stands relative to it.
  int anchor() const;
  common::Pose2 T_anchor_body() const;
  /// The height over the take-off floor that the map shall be of; at first that of the body in the first scan.
  /// True when the map is another one now.
  bool setFlightHeight(double height_m);
  /// What may touch the hull at flight height, as known now; tiles are shared, cheap.
  common::OccupancyGrid snapshot();

  /// Heavy work, when there is any and none is outstanding.
  [[nodiscard]] std::optional<SlamTask> takeTask();
  /// The last work, when no more scans come: the graph as a whole. None may be outstanding.
  [[nodiscard]] std::optional<SlamTask> takeLastTask();
  /// Takes the result of the outstanding task; true when T_map_odom or the grid changed.
  bool apply(const SlamResult& result);

  const SlamCounts& counts() const;
  struct KeyPose {
    common::Time stamp;
    common::Pose2 T_map_body;
  };
  /// Every key scan at its best pose so far.
  std::vector<KeyPose> keyPoses() const;
  /// The constraints between them, as indices into keyPoses().
  const std::vector<SlamEdge>& edges() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
