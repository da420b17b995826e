// From raw samples to a state: IMU -> error-state filter; scan -> projection -> matching -> altitude -> filter -> SLAM.
//
//   IMU sample ----------------------------------------------> predict --+
//   scan --> project --> match to the local map --> relative pose -----> |  error-state filter --> VehicleState
//                  \--> mirror beams --> levels --> virtual height ----> |          |
//                   \--> SLAM (map, T_map_odom) <---------------- pose at the scan -+
//                    \--> localization in a given map, where there is one <---------+
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "autonomy/flight_localizer.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "control/emergency_descent.hpp"
#include "perception/altitude/multilevel_filter.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/laser_odometry/laser_odometry.hpp"
#include "perception/people/people_tracker.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam2d.hpp"

namespace swiftlet::autonomy {

struct EstimatorConfig {
  perception::ScanProjectionConfig projection;
  perception::LaserOdometryConfig odometry;
  perception::MultilevelFilter::Config altitude;
  perception::ErrorStateFilter::Config fusion;
  perception::PeopleTracker::Config people;
  perception::Slam2dConfig slam;
  FlightLocalizerConfig localization;
  double match_floor_m = 0.004;
  double match_floor_deg = 0.10;
  double drift_floor_m = 0.002;
  double drift_floor_deg = 0.03;
  double match_per_tilt_m_rad = 0.05;
  double match_per_tilt_deg_rad = 1.5;
  double slam_latency_s = 0.4;

  void describe(common::config::Fields& fields);
};

/// What one scan gave.
struct ScanOutcome {
  perception::ProjectedScan scan;
  bool matched = false;
  common::Pose2 T_map_body;  ///< At the scan's stamp.
  std::optional<control::RawHeight> raw_height;
};

/// One thread; the jobs of SLAM and localization go to the runner it is given.
class Estimator {
 public:
  /// `given` is a map to localize in; none: null.
  Estimator(const EstimatorConfig& config, const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
            const GivenMap* given, common::JobRunner& jobs);

  void addImu(const common::ImuSample& sample);
  /// Before the filter is initialized a scan initializes it (the vehicle stands still) and gives nothing.
  std::optional<ScanOutcome> addScan(const common::LaserScan& scan, common::Time now);

  bool ready() const { return filter_.initialized(); }
  /// The height over the take-off floor that the map is to be of.
  void setFlightHeight(double height_m) { grid_version_ += slam_.setFlightHeight(height_m) ? 1 : 0; }
  /// While true the filter is told that the vehicle stands.
  void setAtRest(bool at_rest) { filter_.setAtRest(at_rest); }
  /// Only while true scans are looked at for where they are in the given map: near the floor they see what stands
  /// there.
  void setAtFlightHeight(bool is) { at_flight_height_ = is; }

  /// At the newest IMU sample, with T_map_odom.
  common::VehicleState state() const;
  perception::FusionHealth health() const { return filter_.health(); }

  std::shared_ptr<const common::OccupancyGrid> grid();
  std::shared_ptr<const common::LevelMap> levels();
  const perception::PeopleTracker& people() const { return people_; }
  /// None: no map was given.
  std::optional<common::Localization> localization() const;

  std::vector<common::Event> takeEvents();

 private:
  void initialize(const common::LaserScan& scan);
  perception::ProjectedScan projectScan(const common::LaserScan& scan);
  bool withholds(const perception::ProjectedScan& scan);
  bool fuseOdometry(const perception::ProjectedScan& scan);
  void anchorOdometry(common::Time reference);
  Eigen::Matrix3d tiltCovariance(const perception::ProjectedScan& scan, double floor_m, double floor_deg) const;
  void fuseHeight(const perception::ProjectedScan& scan, const common::Pose2& T_map_body);
  void addToMap(ScanOutcome& outcome, common::Time now);
  void submitSlamTask(common::Time now);
  void reportHealth(common::Time now);
  void say(common::Time now, common::Severity severity, std::string source, std::string text, std::string reason = {});

  EstimatorConfig config_;
  common::LaserConfig laser_;
  common::VehicleConfig vehicle_;
  common::JobRunner& jobs_;

  perception::ErrorStateFilter filter_;
  perception::PeopleTracker people_;
  perception::LaserOdometry odometry_;
  perception::MultilevelFilter altitude_;
  perception::Slam2d slam_;
  std::unique_ptr<FlightLocalizer> localizer_;  ///< Null: no map was given.
  bool at_flight_height_ = false;

  /// The way of the laser odometry since a clone of the filter's pose. Its references are not cloned one after the
  /// other: the error of a reference in the local map is that of all that is matched to it, and ends with it.
  struct Track {
    common::Time clone;
    common::Pose2 T_clone_reference;
  } track_;
  std::optional<common::ImuSample> last_imu_;
  bool waiting_said_ = false;
  double height_above_ground_m_ = 0.0;
  Eigen::Matrix3d covariance_since_map_ = Eigen::Matrix3d::Zero();
  perception::FusionStatus last_health_ = perception::FusionStatus::kNotInitialized;
  std::uint64_t grid_version_ = 0;
  std::uint64_t published_grid_version_ = 0;
  std::shared_ptr<const common::OccupancyGrid> published_grid_;
  std::uint64_t published_levels_version_ = 0;
  std::shared_ptr<const common::LevelMap> published_levels_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
