// Computes the motion of the vehicle from sweeps of the laser.
//
//   sweep --> project by the filter's poses --> match to the local map --> relative pose since a clone --> OdometryStep
//
// It does not refer to the filter. Its inputs and outputs are values.
#pragma once

#include <memory>
#include <optional>

#include "autonomy/estimation/odometry_step.hpp"
#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "perception/laser_odometry/laser_odometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {
class LeaningWalls;
}

namespace swiftlet::autonomy {

struct LaserPipelineConfig {
  perception::ScanProjectionConfig projection;
  perception::LaserOdometryConfig odometry;
  double match_rate_hz = 0.0;

  void describe(common::config::Fields& fields);
};

/// The filter's data that the match of a scan needs.
struct FilterView {
  std::optional<common::Pose2> T_odom_last;  ///< Pose at LaserPipeline::lastMatch(), from the newest history.
  bool has_clone = false;                    ///< The filter still has the clone of LaserPipeline::clone().
};

/// One thread.
class LaserPipeline {
 public:
  /// Least standard deviation of a match's position: a tenth of a cell of the map.
  static constexpr double kMatchFloor_m = 0.004;
  /// Least position error that a new reference of the odometry adds to its drift.
  static constexpr double kDriftFloor_m = 0.002;

  LaserPipeline(const LaserPipelineConfig& config, const common::LaserConfig& laser);
  ~LaserPipeline();

  perception::ProjectedScan project(const common::LaserScan& scan, const perception::PoseAt& pose_at) const;

  /// Whether a scan of that time is to be matched: false while `match_rate_hz` leaves it to its heights alone.
  bool wants(common::Time stamp) const;

  /// Matches a scan. It must have been projected by poses of the same history as `filter`, so that a correction since
  /// the last match does not count as motion.
  OdometryStep match(const perception::ProjectedScan& scan, const FilterView& filter);

  /// Learns where walls lean, from a scan whose pose is known.
  void learnWalls(const perception::ProjectedScan& scan, const common::Pose3& T_odom_body);
  /// The scan at the height of the body: ends on leaning walls are moved along these.
  perception::ProjectedScan atBodyHeight(perception::ProjectedScan scan) const;

  /// See LaserOdometry::refused.
  void refused(bool by_filter) { odometry_.refused(by_filter); }

  /// The stamp of the last scan that matched; none before the first.
  std::optional<common::Time> lastMatch() const { return odometry_.lastMatch(); }
  const perception::LaserOdometryCounts& counts() const { return odometry_.counts(); }
  /// The time of the clone that the next measurement starts from.
  common::Time clone() const { return track_.clone; }

 private:
  std::optional<common::UnobservableMotion> hiddenMotion(const perception::RelativePose& relative,
                                                         const common::Pose2& T_clone_body);
  common::UnobservableMotion unobservableMotion(const common::UnobservableMotion& measured_clone,
                                                const common::Pose2& T_clone_body);
  OdometryStep restart(const perception::RelativePose& relative, bool interrupted);
  Eigen::Matrix3d tiltCovariance(const perception::ProjectedScan& scan, double floor_m, double floor_deg) const;

  LaserPipelineConfig config_;
  common::LaserConfig laser_;
  std::unique_ptr<perception::LeaningWalls> walls_;
  perception::LaserOdometry odometry_;
  std::optional<common::Time> asked_;  ///< Stamp of the last scan that was to be matched.

  /// The pose of the odometry's reference scan relative to a clone of the filter's pose. A new reference gets no clone
  /// of its own, because the error of a reference is shared by the scans matched to it and does not outlast it.
  struct Track {
    common::Time clone;
    common::Pose2 T_clone_reference;
    /// What the walls last did not show of the motion, as the change of a body at the clone, along its axes.
    std::optional<common::UnobservableMotion> unobservable_clone;
    common::Time hidden_at;  ///< The last scan that did not show it.
  } track_;
};

}  // namespace swiftlet::autonomy
