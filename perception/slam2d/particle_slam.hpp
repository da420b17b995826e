// SLAM by a Rao-Blackwellized particle filter: each particle is a trajectory with the map drawn along it. This is
// GMapping (Grisetti, Stachniss and Burgard 2007), modified for flight (Bachrach 2009, section 5.3). Particles move by
// the laser odometry and its covariance, since there are no wheels. The confidence of cells is capped, so that the map
// follows what changes with the height.
//
//   scan --> far enough? --> for each particle: match to its map --> sample its pose, weigh it, draw --> resample
//
// The map covers one height band (SurfaceMap): what may touch the hull at flight height. Each scan is drawn with the
// band that is set at its time. A scan from outside the band is matched and weighed, but not drawn. The map changes
// when a scan is taken in, and when something has gone from a map in slices that is drawn along the best trajectory
// (SlicedMap).
// Maps share the tiles they have in common, and trajectories share their common past.
// T_map_odom jumps when a scan is taken in. All key scans may move then, because another particle may be the best.
#pragma once

#include <memory>
#include <vector>

#include "perception/slam2d/grid_drawing_config.hpp"
#include "perception/slam2d/planar_slam.hpp"

namespace swiftlet::perception {

struct ParticleSlamConfig {
  GridDrawingConfig grid;  ///< makeSlam() sets it to that of the published map.
  int count = 30;          ///< Particles.
  int seed = 1;            ///< Seed of the random numbers.
};

/// Key scans are the scans that were taken in. Poses and map are those of the best particle.
class ParticleSlam final : public PlanarSlam {
 public:
  explicit ParticleSlam(const ParticleSlamConfig& config);
  ~ParticleSlam() override;
  ParticleSlam(ParticleSlam&&) noexcept;
  ParticleSlam& operator=(ParticleSlam&&) noexcept;

  SlamMethod method() const override { return SlamMethod::kParticles; }
  SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                     const Eigen::Matrix3d& covariance_since_last) override;

  common::Pose2 T_map_odom() const override;
  int anchor() const override;
  common::Pose2 T_anchor_body() const override;
  std::vector<KeyPose> keyPoses() const override;
  /// Sets the height band for the scans to come. Returns false, because what is drawn already stays.
  bool setFlightHeight(double height_m) override;
  common::OccupancyGrid snapshot() override;
  const SlamCounts& counts() const override;

  common::Pose2 T_map_body() const;
  /// Number of poses stored for all trajectories together.
  std::size_t keptPoses() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
