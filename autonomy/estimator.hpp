// Estimates the state, the map and the people around from raw samples, with one filter:
//
//   IMU sample --> predict --------------------------------> error-state filter --> VehicleState
//   scan --> project --> leave out people --> match --> fuse ---^   |
//                \--> altitude over levels -----------> fuse ---^   v
//                 \--> map <-------------------------- pose at the scan --> localize in a given map
//                       \--> people, for the next scan
//   RGB-D frame --> 3D map, targets and recognized objects, at the pose of its own time
//   sweep of an upright laser --> 3D map, at the poses of its beams' own times
//
// Each step is a small object that takes values and returns values; only the Estimator uses the filter.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimation/altitude_pipeline.hpp"
#include "autonomy/estimation/flight_start.hpp"
#include "autonomy/estimation/given_map_place.hpp"
#include "autonomy/estimation/heard_filter.hpp"
#include "autonomy/estimation/laser_pipeline.hpp"
#include "autonomy/estimation/map_pipeline.hpp"
#include "autonomy/estimation/pose_track.hpp"
#include "autonomy/estimation/position_uncertainty.hpp"
#include "autonomy/estimation/space_sensors.hpp"
#include "autonomy/feedback.hpp"
#include "autonomy/inertial/horizon_offset.hpp"
#include "common/config_fwd.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/rgbd_camera_config.hpp"
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
  LaserPipelineConfig laser;  ///< Its keys are on the level of the estimator's own.
  perception::MultilevelFilter::Config altitude;
  perception::ErrorStateFilter::Config fusion;
  perception::SlamMethodConfig slam;
  FlightLocalizerConfig localization;
  RgbdPipelineConfig rgbd;
  VerticalLaserPipelineConfig vertical_laser;
  TargetPipelineConfig targets;
  std::vector<perception::KnownObjectConfig> recognition;
  double slam_latency_s = 0.4;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// The results of one scan.
struct ScanOutcome {
  perception::ProjectedScan scan;
  bool matched = false;                           ///< The scan matched and the filter accepted the match.
  bool interrupted = false;                       ///< The odometry was lost and restarts with this scan.
  common::Pose2 T_map_body;                       ///< At the scan's stamp.
  std::optional<common::KeyRelativePose> at_key;  ///< Pose of the body relative to a key scan of the map.
  /// nullopt if the scan did not measure the surface below.
  std::optional<control::RawHeight> raw_height;
  double drift_m = 0.0;                           ///< See DriftMonitor.
  std::vector<perception::GoneColumn> gone = {};  ///< What has gone from the map with this scan.
};

/// The filter's data on a body in motion, beside its state.
struct BodyMotion {
  /// Acceleration at the newest IMU sample, gravity and bias removed; nullopt before the filter has started.
  std::optional<Eigen::Vector3d> acceleration_odom_m_s2;
  Eigen::Vector2d horizon_offset_rad;  ///< See HorizonOffset.
};

/// The maps of the flight, and what is in them.
struct EstimatedMaps {
  std::shared_ptr<const common::OccupancyGrid> grid;
  std::shared_ptr<const common::KeyPoses> key_poses;
  std::shared_ptr<const common::LevelMap> levels;
  /// Null without a camera and an upright laser, and before the first frame or sweep.
  std::shared_ptr<const common::Map3dLayer> map3d;
  std::vector<common::Target> targets;  ///< Targets that the profile names, as the camera has seen them.
  std::shared_ptr<const common::ObjectsLayer> objects;  ///< Null unless the profile names something to recognize.
  std::optional<common::Localization> localization;     ///< nullopt without a given map.
};

/// What the parts have counted so far.
struct EstimatorCounts {
  perception::LaserOdometryCounts odometry;
  perception::SlamCounts slam;
  std::optional<RgbdCounts> camera;             ///< nullopt without a camera.
  std::optional<mapping3d::RadioCounts> radio;  ///< nullopt without a camera whose frames come over a radio.
};

/// One thread. The jobs of SLAM and localization are submitted to `jobs`, which must not deliver after its destruction.
class Estimator {
 public:
  /// `given` is a map to localize in, or null; `camera` or else `vertical_laser` makes the 3D map, or both are null.
  /// All are read only here.
  Estimator(const EstimatorConfig& config, const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
            const GivenMap* given, common::JobRunner& jobs, common::EventLog& log,
            const common::RgbdCameraConfig* camera = nullptr, const common::LaserConfig* vertical_laser = nullptr);
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;

  /// What the last tick has flown. A given map that it loads replaces the present one, and the vehicle is no longer
  /// localized.
  void hear(const Feedback& feedback);
  /// The sample as it came from a vehicle with an AHRS. In one without, where FusionConfig::use_ahrs is false, it gets
  /// the filter's attitude; before the filter starts that by gravity, which is not finite while the vehicle moves.
  common::ImuSample withAttitude(const common::ImuSample& sample) const {
    return start_.withAttitude(sample, *filter_);
  }
  /// A `predicted` sample was not measured; see ErrorStateFilter::setPredicted.
  void addImu(const common::ImuSample& sample, bool predicted = false);
  /// Processes a scan at `now`. The first scans, taken while the vehicle stands still, only initialize the filter and
  /// return nothing.
  std::optional<ScanOutcome> addScan(const common::LaserScan& scan, common::Time now);
  /// Whether the frame can be used; other users of the frame rely on this check. False without a camera.
  [[nodiscard]] bool addFrame(std::shared_ptr<const common::RgbdFrame> frame);
  /// Without an upright laser the sweep is ignored.
  void addSweep(std::shared_ptr<const common::VerticalScan> sweep) { space_.add(std::move(sweep)); }
  /// Maps frames and sweeps that wait as soon as the poses at their times are known, and looks for targets in frames,
  /// which are reported by these names of places. To be called after the scans of every tick.
  void updateMap3d(common::Time now, const common::PlaceNames& names = {});

  bool ready() const { return filter_->initialized(); }
  /// Why a flight from where the vehicle stands would not know its height or position; empty if it would. See
  /// StartView::problem.
  std::string whyUnready(common::Time now) const;
  /// Gets all inputs of the filter from now on; null for no listener. It must outlive the estimator.
  void setFilterListener(perception::FilterListener* listener) { filter_.setListener(listener); }

  /// The state at the newest IMU sample, with T_map_odom.
  common::VehicleState state() const;
  BodyMotion motion() const;
  perception::FusionHealth health() const { return filter_->health(); }
  double drift_m() const { return uncertainty_.drift_m(); }  ///< See DriftMonitor; as of the last scan.
  const perception::PeopleTracker& people() const { return people_; }
  EstimatedMaps maps();
  /// See AltitudePipeline::seenSurfaces.
  common::LevelMap seenSurfaces() const { return altitude_.seenSurfaces(); }
  EstimatorCounts counts() const { return {laser_.counts(), map_.counts(), space_.counts(), space_.radioCounts()}; }

 private:
  /// When a sensor last measured each; time of processing, not of measuring.
  struct Seen {
    common::Time position, height;
  };

  void begin(const common::LaserScan& scan);
  perception::ProjectedScan project(const common::LaserScan& scan) const;
  perception::ProjectedScan withoutPeople(const perception::ProjectedScan& scan, common::Time measured) const;
  void measureHeight(ScanOutcome& outcome, const common::Pose2& T_odom_body, common::Time now);
  bool isWithheld(const perception::ProjectedScan& scan);
  OdometryStep match(const perception::ProjectedScan& scan);
  bool fuse(const OdometryStep& step, common::Time now);
  void fuse(const AltitudeStep& step, common::Time stamp);
  void fuse(const CameraStep& step, common::Time now);
  void localize(const LocatedScan& located, common::Time now);
  void lookAtGround(const common::RgbdFrame& frame);
  common::Pose3 T_odom_bodyAt(const perception::ProjectedScan& scan) const;

  common::EventLog& log_;
  HeardFilter filter_;
  FlightStart start_;
  perception::PeopleTracker people_;
  LaserPipeline laser_;
  AltitudePipeline altitude_;
  MapPipeline map_;
  GivenMapPlace localizer_;
  SpaceSensors space_;
  PoseTrack poses_;
  PositionUncertainty uncertainty_;
  HorizonOffset horizon_;
  Feedback flown_;  ///< In the last tick.
  Seen seen_;
};

}  // namespace swiftlet::autonomy
