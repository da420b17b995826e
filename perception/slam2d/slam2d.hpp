// Graph SLAM in the plane (Grzonka 2009, section V-D): key scans are nodes and matches are edges. Loop closures are
// searched for where the projected uncertainty allows them. The map is an occupancy grid drawn from the scans at their
// best poses.
//
// In flight each scan costs a fraction of a millisecond: a key scan is matched to the older key scans around it, which
// bounds the drift inside known area, and is drawn into the grid. The heavy work (loop search, optimization, drawing
// the grid again) is a value: takeTask() returns it, run() computes it on any thread, apply() uses the result.
//
// T_map_odom jumps with a local correction (by millimetres, at a key scan) and with a loop closure (in apply()).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "perception/slam2d/planar_slam.hpp"
#include "perception/slam2d/slam_config.hpp"

namespace swiftlet::perception {

class Slam2d final : public PlanarSlam {
 public:
  explicit Slam2d(const Slam2dConfig& config);
  ~Slam2d() override;
  Slam2d(Slam2d&&) noexcept;
  Slam2d& operator=(Slam2d&&) noexcept;

  SlamMethod method() const override { return SlamMethod::kGraph; }
  SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                     const Eigen::Matrix3d& covariance_since_last) override;

  common::Pose2 T_map_odom() const override;
  int anchor() const override;
  common::Pose2 T_anchor_body() const override;
  std::vector<KeyPose> keyPoses() const override;
  bool setFlightHeight(double height_m) override;
  common::OccupancyGrid snapshot() override;
  const SlamCounts& counts() const override;

  std::span<const SlamEdge> edges() const override;

  [[nodiscard]] std::optional<SlamTask> takeTask() override;
  /// A task that optimizes the whole graph, then tasks that repair a map that contradicts itself.
  [[nodiscard]] std::optional<SlamTask> takeLastTask() override;
  bool apply(const SlamResult& result) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
