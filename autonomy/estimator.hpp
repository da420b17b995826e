// From raw samples to a state, a map and the people around, one step after the other around one filter:
//
//   IMU sample --> predict --------------------------------> error-state filter --> VehicleState
//   scan --> project --> leave out people --> match --> fuse ---^   |
//                \--> altitude over levels -----------> fuse ---^   v
//                 \--> map <-------------------------- pose at the scan --> localize in a given map
//                       \--> people, for the next scan
//
// Each step is a small object that takes values and returns values; only the Estimator speaks with the filter.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimation/altitude_pipeline.hpp"
#include "autonomy/estimation/flight_localizer.hpp"
#include "autonomy/estimation/laser_pipeline.hpp"
#include "autonomy/estimation/map_pipeline.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "control/emergency_descent.hpp"
#include "perception/altitude/multilevel_filter.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/people/people_tracker.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam_method.hpp"

namespace swiftlet::autonomy {

struct EstimatorConfig {
  LaserPipelineConfig laser;  ///< Its keys stand among those of the estimator.
  perception::MultilevelFilter::Config altitude;
  perception::ErrorStateFilter::Config fusion;
  perception::PeopleTracker::Config people;
  perception::SlamMethodConfig slam;
  FlightLocalizerConfig localization;
  double slam_latency_s = 0.4;

  void describe(common::config::Fields& fields);
};

/// What one scan gave.
struct ScanOutcome {
  perception::ProjectedScan scan;
  bool matched = false;                           ///< It matched and the filter took it in.
  bool interrupted = false;                       ///< The odometry was lost, and begins anew with this scan.
  common::Pose2 T_map_body;                       ///< At the scan's stamp.
  std::optional<common::KeyRelativePose> at_key;  ///< The same relative to a key scan of the map.
  std::optional<control::RawHeight> raw_height;
};

/// One thread; the jobs of SLAM and localization go to the runner it is given, which must not deliver after its end.
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
  void setFlightHeight(double height_m) { map_.setFlightHeight(height_m); }
  /// While true the filter is told that the vehicle stands.
  void setAtRest(bool at_rest) { filter_.setAtRest(at_rest); }
  /// Only while true scans are compared with the given map: near the floor they meet what stands there.
  void setAtFlightHeight(bool is) { at_flight_height_ = is; }

  /// At the newest IMU sample, with T_map_odom.
  common::VehicleState state() const;
  perception::FusionHealth health() const { return filter_.health(); }
  const perception::LaserOdometryCounts& odometryCounts() const { return laser_.counts(); }
  const perception::SlamCounts& slamCounts() const { return map_.counts(); }

  std::shared_ptr<const common::OccupancyGrid> grid() { return map_.grid(); }
  std::shared_ptr<const common::KeyPoses> keyPoses() { return map_.keyPoses(); }
  std::shared_ptr<const common::LevelMap> levels() { return altitude_.levels(); }
  const perception::PeopleTracker& people() const { return people_; }
  /// None: no map was given.
  std::optional<common::Localization> localization() const;

  std::vector<common::Event> takeEvents();

 private:
  void initialize(const common::LaserScan& scan);
  perception::ProjectedScan project(const common::LaserScan& scan) const;
  perception::ProjectedScan withoutPeople(const perception::ProjectedScan& scan, common::Time measured) const;
  bool isWithheld(const perception::ProjectedScan& scan);
  OdometryStep match(const perception::ProjectedScan& scan);
  bool fuse(const OdometryStep& step);
  void fuse(const AltitudeStep& step, common::Time stamp);
  void localize(const LocatedScan& located, common::Time now);
  common::Pose3 T_odom_bodyAt(const perception::ProjectedScan& scan) const;
  void reportHealth(common::Time now);
  void say(common::Time now, common::Severity severity, std::string source, std::string text, std::string reason = {});

  double standing_height_m_;  ///< Of the body, where the mirror shows no floor.
  perception::ErrorStateFilter filter_;
  perception::PeopleTracker people_;
  LaserPipeline laser_;
  AltitudePipeline altitude_;
  MapPipeline map_;
  std::unique_ptr<FlightLocalizer> localizer_;  ///< Null: no map was given.

  std::optional<common::ImuSample> last_imu_;
  bool at_flight_height_ = false;
  bool waiting_said_ = false;
  perception::FusionStatus last_health_ = perception::FusionStatus::kNotInitialized;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
