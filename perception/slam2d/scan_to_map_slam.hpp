// SLAM by matching each scan to the one map that the scans are drawn into (Saeedi, section III-B, after Kohlbrecher
// 2011). The pose of a scan is
//
//   argmin over (x, y, psi) of the sum over i of (1 - M(S_i(x, y, psi)))^2        (Saeedi, eq. 1)
//
// where S_i is the end point i at the pose, and M is the map, interpolated between its cells. The first-order expansion
// of M gives the Gauss-Newton step (Kohlbrecher, eq. 7 to 13). It is repeated on a pyramid of maps from coarse to fine
// (section V-B there). GaussNewtonMatcher implements this.
// The papers interpolate the occupancy of the cells. Here M is 1 on the surfaces in the occupied cells (SurfaceMap) and
// falls linearly with the distance from them. So a scan is pulled to the surface of a wall, not to the middle of its
// cells.
//
//   scan --> far enough? --> match to the surfaces around --> weigh against the motion --> key scan? --> draw
//
// There is no loop closure and no optimization: a key scan keeps its first pose. The error grows with the distance from
// known area. A loop whose error is larger than the search window is not closed, and the map then shows its walls
// twice. The method is for rooms and short flights.
//
// T_map_odom changes with each scan that matches. A scan that does not match leaves it as it is, so that the pose
// follows the odometry.
#pragma once

#include <memory>
#include <vector>

#include "perception/slam2d/grid_drawing_config.hpp"
#include "perception/slam2d/planar_slam.hpp"

namespace swiftlet::perception {

/// Key scans are drawn into the surfaces that other scans are matched to. The published map is a SlicedMap, into which
/// key scans and all scans that match are drawn.
class ScanToMapSlam final : public PlanarSlam {
 public:
  /// Standard deviation of the map about the pose: however often a scan matches the same map, no pose in it is more
  /// certain.
  static constexpr double kMapSigma_m = 0.005;
  /// Standard deviation of the map's rotation about the pose.
  static constexpr double kMapSigma_deg = 0.1;

  explicit ScanToMapSlam(const GridDrawingConfig& config);
  ~ScanToMapSlam() override;
  ScanToMapSlam(ScanToMapSlam&&) noexcept;
  ScanToMapSlam& operator=(ScanToMapSlam&&) noexcept;

  SlamMethod method() const override { return SlamMethod::kScanToMap; }
  SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                     const Eigen::Matrix3d& covariance_since_last) override;

  common::Pose2 T_map_odom() const override;
  int anchor() const override;
  common::Pose2 T_anchor_body() const override;
  std::vector<KeyPose> keyPoses() const override;
  bool setFlightHeight(double height_m) override;
  common::OccupancyGrid snapshot() override;
  const SlamCounts& counts() const override;

  /// The covariance of the additive errors (x_m, y_m, yaw_rad) of the last scan's pose, axes of the map. It is relative
  /// to the map around the pose: the drift of that map since take-off is not included. After a match, no standard
  /// deviation is below `kMapSigma_m` or `kMapSigma_deg`.
  const Eigen::Matrix3d& covariance() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
