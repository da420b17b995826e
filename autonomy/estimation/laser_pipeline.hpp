// From a sweep of the laser to what it says of the motion.
//
//   sweep --> project by the filter's poses --> match to the local map --> relative pose since a clone --> OdometryStep
//
// It holds no filter: what it needs of it comes in as values, what it gives are values.
#pragma once

#include <optional>

#include "autonomy/estimation/odometry_step.hpp"
#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "perception/laser_odometry/laser_odometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::autonomy {

struct LaserPipelineConfig {
  perception::ScanProjectionConfig projection;
  perception::LaserOdometryConfig odometry;
  double match_floor_m = 0.004;
  double match_floor_deg = 0.10;
  double drift_floor_m = 0.002;
  double drift_floor_deg = 0.03;
  double match_per_tilt_m_rad = 0.05;
  double match_per_tilt_deg_rad = 1.5;

  void describe(common::config::Fields& fields);
};

/// What the filter knows when a scan is to be matched.
struct FilterView {
  std::optional<common::Pose2> T_odom_last;  ///< At LaserPipeline::lastMatch(), from the newest history.
  bool has_clone = false;                    ///< Of LaserPipeline::clone().
};

/// One thread.
class LaserPipeline {
 public:
  LaserPipeline(const LaserPipelineConfig& config, const common::LaserConfig& laser);

  perception::ProjectedScan project(const common::LaserScan& scan, const perception::PoseAt& pose_at) const;

  /// Matches a scan that was projected by poses of the same history as `filter`, so that a correction since the last
  /// match does not count as motion.
  OdometryStep match(const perception::ProjectedScan& scan, const FilterView& filter);

  /// The stamp of the last scan that matched; none before the first.
  std::optional<common::Time> lastMatch() const { return odometry_.lastMatch(); }
  const perception::LaserOdometryCounts& counts() const { return odometry_.counts(); }
  /// The time of the clone that the next measurement starts from.
  common::Time clone() const { return track_.clone; }

 private:
  OdometryStep restart(const perception::RelativePose& relative, bool interrupted);
  Eigen::Matrix3d tiltCovariance(const perception::ProjectedScan& scan, double floor_m, double floor_deg) const;

  LaserPipelineConfig config_;
  common::LaserConfig laser_;
  perception::LaserOdometry odometry_;

  /// The path of the laser odometry since a clone of the filter's pose. Its references are not cloned one after the
  /// other: the error of a reference in the local map is that of all that is matched to it, and ends with it.
  struct Track {
    common::Time clone;
    common::Pose2 T_clone_reference;
  } track_;
};

}  // namespace swiftlet::autonomy
