// SLAM by a Rao-Blackwellized particle filter: each particle is a trajectory with the map drawn along it. GMapping
// (Grisetti, Stachniss and Burgard 2007) as modified for flight (Bachrach 2009, section 5.3): no wheels, but the motion
// that the laser's own matcher measured, with the uncertainty it says, moves the particles; and the confidence of cells
// is capped, so that the map follows what changes with the height.
//
//   scan --> far enough? --> for each particle: match to its map --> sample its pose, weigh it, draw --> resample
//
// Frames: the poses given are T_odom_body, continuous. The map frame is that of the first pose. The maps share the
// tiles they have in common, the trajectories their common past.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"
#include "perception/slam2d/particle/map_match.hpp"
#include "perception/slam2d/particle/particle_map.hpp"
#include "perception/slam2d/slam2d.hpp"

namespace swiftlet::perception {

struct ParticleSlamConfig {
  ParticleMapConfig map;
  MapMatchConfig match;
  int particles = 30;
  int seed = 1;                       ///< Of the random numbers.
  double update_distance_m = 0.3;     ///< A scan is taken in after this distance,
  double update_rotation_deg = 15.0;  ///< this rotation,
  double update_time_s = 2.0;         ///< or this time.
  double motion_sigma_m = 0.004;      ///< No motion between two of them is more certain than this: what the matcher
  double motion_sigma_deg = 0.06;     ///< cannot know (tilt, clutter).
  double news_share = 0.25;           ///< Of what a scan says of a map: the scans before it said the rest already.
  double min_effective_share = 0.5;   ///< Resampled when the effective particles are a smaller share of all.
  int min_points = 30;                ///< A scan with fewer points is not the first.
};

struct ParticleSlamCounts {
  std::uint64_t scans = 0;
  std::uint64_t ignored_scans = 0;  ///< Out of order, or without a finite pose.
  std::uint64_t updates = 0;        ///< Scans that were taken in.
  std::uint64_t resamplings = 0;
};

/// Single-threaded. Deterministic: the same scans and seed give the same bytes.
class ParticleSlam {
 public:
  explicit ParticleSlam(const ParticleSlamConfig& config);
  ~ParticleSlam();
  ParticleSlam(ParticleSlam&&) noexcept;
  ParticleSlam& operator=(ParticleSlam&&) noexcept;

  /// `covariance_since_last`: of the motion since the last scan given here, of the additive errors (x_m, y_m, yaw_rad)
  /// in the body frame of that last scan. True when the scan was taken in.
  bool addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
               const Eigen::Matrix3d& covariance_since_last);

  /// The last scan that was taken in (of keyPoses(); -1: none), and where the last scan stands relative to it.
  int anchor() const;
  common::Pose2 T_anchor_body() const;
  /// Of the best particle.
  common::Pose2 T_map_body() const;
  /// The trajectory of the best particle: where each scan that was taken in stands.
  std::vector<Slam2d::KeyPose> keyPoses() const;
  /// Its map.
  common::OccupancyGrid map() const;

  const ParticleSlamCounts& counts() const;
  /// Poses that are kept for all trajectories together.
  std::size_t keptPoses() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
