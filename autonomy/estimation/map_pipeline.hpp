// Makes the 2D map, the correction T_map_odom and the key scans from matched scans, with the SLAM method of the
// profile. Heavy work of the method runs as a job.
//
//   scan, pose in odom, drift since the last one --> PlanarSlam --> MapStep
//                                                         \--> loop search and optimization, a job --> late correction
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/event_log.hpp"
#include "common/geometry.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/planar_slam.hpp"

namespace swiftlet::perception {
struct SlamMethodConfig;
}  // namespace swiftlet::perception

namespace swiftlet::autonomy {

/// A scan with the filter's results for it.
struct MappedScan {
  const perception::ProjectedScan& scan;
  common::Pose3 T_odom_body;                                  ///< The filter's pose at its stamp.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();  ///< Of the motion since the last scan, axes of the body.
  bool matched = false;                                       ///< An unmatched scan is not added to the map.
};

struct MapStep {
  common::Pose2 T_map_body;  ///< At the scan's stamp.
  /// Pose of the body relative to a key scan, for data that must move with the map; nullopt before the first scan in
  /// the map.
  std::optional<common::KeyRelativePose> at_key;
  int known_key = -1;                             ///< perception::SlamUpdate::known_key.
  std::vector<perception::GoneColumn> gone = {};  ///< perception::SlamUpdate::gone.
};

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class MapPipeline {
 public:
  MapPipeline(const perception::SlamMethodConfig& config, common::Duration job_latency, common::JobRunner& jobs,
              common::EventLog& log);
  MapPipeline(const MapPipeline&) = delete;
  MapPipeline& operator=(const MapPipeline&) = delete;

  MapStep add(const MappedScan& mapped, common::Time now);

  /// It jumps when the method corrects the odometry: by millimetres at a match, by more at a loop closure.
  common::Pose2 T_map_odom() const { return slam_->T_map_odom(); }
  /// Sets the height over the take-off floor at which grid() shows the map.
  void setFlightHeight(double height_m) { grid_version_ += slam_->setFlightHeight(height_m) ? 1 : 0; }

  /// Never null; the same object until the map changes.
  std::shared_ptr<const common::OccupancyGrid> grid();
  /// Never null; the same object until a key scan is added or moved.
  std::shared_ptr<const common::KeyPoses> keyPoses();
  const perception::SlamCounts& counts() const { return slam_->counts(); }

 private:
  void submitTask(common::Time now);
  void take(const perception::SlamResult& result, common::Time delivered);

  common::Duration job_latency_;
  common::JobRunner& jobs_;
  std::unique_ptr<perception::PlanarSlam> slam_;  ///< Never null.

  Eigen::Matrix3d covariance_since_map_ = Eigen::Matrix3d::Zero();  ///< Of the odometry since the last added scan.
  common::Pose2 T_odom_mapped_;                                     ///< T_odom_body at the last added scan.
  std::uint64_t grid_version_ = 0, keys_version_ = 0, published_grid_version_ = 0;
  std::shared_ptr<const common::OccupancyGrid> published_grid_;
  std::shared_ptr<const common::KeyPoses> published_keys_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
