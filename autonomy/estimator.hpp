// Estimates the state, the map and the people around from raw samples, with one filter:
//
//   IMU sample --> predict --------------------------------> error-state filter --> VehicleState
//   scan --> project --> leave out people --> match --> fuse ---^   |
//                \--> altitude over levels -----------> fuse ---^   v
//                 \--> map <-------------------------- pose at the scan --> localize in a given map
//                       \--> people, for the next scan
//   RGB-D frame --> 3D map, and targets, at the pose of its own time
//   sweep of an upright laser --> 3D map, at the poses of its beams' own times
//
// Each step is a small object that takes values and returns values; only the Estimator uses the filter.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimation/altitude_pipeline.hpp"
#include "autonomy/estimation/drift_monitor.hpp"
#include "autonomy/estimation/flight_localizer.hpp"
#include "autonomy/estimation/laser_pipeline.hpp"
#include "autonomy/estimation/map_pipeline.hpp"
#include "autonomy/estimation/rgbd_pipeline.hpp"
#include "autonomy/estimation/start_view.hpp"
#include "autonomy/estimation/step_uncertainty.hpp"
#include "autonomy/estimation/target_pipeline.hpp"
#include "autonomy/estimation/vertical_laser_pipeline.hpp"
#include "autonomy/inertial/horizon_offset.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "control/emergency_descent.hpp"
#include "perception/altitude/multilevel_filter.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/fusion/filter_tape.hpp"
#include "perception/people/people_tracker.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam_method.hpp"

namespace swiftlet::autonomy {

struct EstimatorConfig {
  LaserPipelineConfig laser;  ///< Its keys are on the level of the estimator's own.
  perception::MultilevelFilter::Config altitude;
  perception::ErrorStateFilter::Config fusion;
  perception::PeopleTracker::Config people;
  perception::SlamMethodConfig slam;
  FlightLocalizerConfig localization;
  RgbdPipelineConfig rgbd;
  VerticalLaserPipelineConfig vertical_laser;
  TargetPipelineConfig targets;
  double slam_latency_s = 0.4;

  void describe(common::config::Fields& fields);
};

/// The results of one scan.
struct ScanOutcome {
  perception::ProjectedScan scan;
  bool matched = false;                           ///< The scan matched and the filter accepted the match.
  bool interrupted = false;                       ///< The odometry was lost and restarts with this scan.
  common::Pose2 T_map_body;                       ///< At the scan's stamp.
  std::optional<common::KeyRelativePose> at_key;  ///< Pose of the body relative to a key scan of the map.
  /// None if the scan did not measure the surface below.
  std::optional<control::RawHeight> raw_height;
  double drift_m = 0.0;  ///< See DriftMonitor.
};

/// One thread. The jobs of SLAM and localization are submitted to `jobs`, which must not deliver after its destruction.
class Estimator {
 public:
  /// `given` is a map to localize in, or null; `camera` or else `vertical_laser` makes the 3D map, or both are null.
  /// All are read only here.
  Estimator(const EstimatorConfig& config, const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
            const GivenMap* given, common::JobRunner& jobs, const common::RgbdCameraConfig* camera = nullptr,
            const common::LaserConfig* vertical_laser = nullptr);

  /// The sample as it came from a vehicle with an AHRS. In one without, where FusionConfig::use_ahrs is false, it gets
  /// the filter's attitude; before the filter starts that by gravity, which is not finite while the vehicle moves.
  common::ImuSample withAttitude(const common::ImuSample& sample) const;
  /// A `predicted` sample was not measured; see ErrorStateFilter::setPredicted.
  void addImu(const common::ImuSample& sample, bool predicted = false);
  /// Processes a scan at `now`. The first scans, taken while the vehicle stands still, only initialize the filter and
  /// return nothing.
  std::optional<ScanOutcome> addScan(const common::LaserScan& scan, common::Time now);

  /// Makes `given` the given map from now on; nothing is known of the vehicle's place in it.
  void loadMap(const GivenMap& given);
  /// The place in the given map is looked for anew; false if there is none.
  bool forgetPlace();

  /// Whether the frame can be used; others that get it ask here instead of judging it again. False without a camera.
  [[nodiscard]] bool addFrame(std::shared_ptr<const common::RgbdFrame> frame);
  /// Without an upright laser the sweep is ignored.
  void addSweep(std::shared_ptr<const common::VerticalScan> sweep);
  /// Maps frames and sweeps that wait as soon as the poses at their times are known, and looks for targets in frames.
  /// To be called after the scans of every tick.
  void updateMap3d(common::Time now);

  /// None without a camera.
  std::optional<RgbdCounts> cameraCounts() const { return rgbd_ ? std::optional(rgbd_->counts()) : std::nullopt; }
  /// None without a camera whose frames come over a radio.
  std::optional<mapping3d::RadioCounts> radioCounts() const { return rgbd_ ? rgbd_->radioCounts() : std::nullopt; }

  bool ready() const { return filter_.initialized(); }
  /// Why a flight from where the vehicle stands would not know its height or position; empty if it would. See
  /// StartView::problem.
  std::string whyUnready(common::Time now) const;
  /// See MapPipeline::setFlightHeight.
  void setFlightHeight(double height_m) { map_.setFlightHeight(height_m); }
  /// So much lower than the height of the map the vehicle flies, below something that hangs over its path.
  void setBelowMap(double below_m) { below_map_m_ = below_m; }
  /// While true, the filter assumes that the vehicle stands still.
  void setAtRest(bool at_rest);
  /// Hears all that the filter is told from now on; null for none. It must outlive the estimator.
  void setFilterListener(perception::FilterListener* listener) { listener_ = listener; }
  /// While false, scans are not compared with the given map, because near the floor the laser sees other objects.
  void setAtFlightHeight(bool is) { at_flight_height_ = is; }

  /// The state at the newest IMU sample, with T_map_odom.
  common::VehicleState state() const;
  /// Acceleration at the newest IMU sample, gravity and bias removed; none before the filter has started.
  std::optional<Eigen::Vector3d> accelerationOdom_m_s2() const;
  /// See HorizonOffset.
  const Eigen::Vector2d& horizonOffset_rad() const { return horizon_.offset_rad(); }
  perception::FusionStatus fusionStatus() const { return filter_.status(); }
  perception::FusionHealth health() const { return filter_.health(); }
  const perception::LaserOdometryCounts& odometryCounts() const { return laser_.counts(); }
  const perception::SlamCounts& slamCounts() const { return map_.counts(); }

  std::shared_ptr<const common::OccupancyGrid> grid() { return map_.grid(); }
  std::shared_ptr<const common::KeyPoses> keyPoses() { return map_.keyPoses(); }
  std::shared_ptr<const common::LevelMap> levels() { return altitude_.levels(); }
  /// See AltitudePipeline::seenSurfaces.
  common::LevelMap seenSurfaces() const { return altitude_.seenSurfaces(); }
  /// Null without a camera and an upright laser, and before the first frame or sweep.
  std::shared_ptr<const common::Map3dLayer> map3d();
  /// What the camera has seen of the targets that the profile names.
  std::vector<common::Target> targets();
  const perception::PeopleTracker& people() const { return people_; }
  /// None if no map was given.
  std::optional<common::Localization> localization() const;

  std::vector<common::Event> takeEvents(const common::PlaceNames& names = {});

 private:
  /// Tells the listener and then the filter; nothing else changes the filter. Returns what perception::tell returns.
  tl::expected<perception::Insertion, std::string> tell(const perception::FilterInput& input);
  void initialize(const common::LaserScan& scan);
  void lookFromStart(const common::LaserScan& scan, const Eigen::Quaterniond& R_odom_body);
  void sayWaiting(common::Time now, std::string reason);
  perception::ProjectedScan project(const common::LaserScan& scan) const;
  perception::ProjectedScan withoutPeople(const perception::ProjectedScan& scan, common::Time measured) const;
  void measureHeight(ScanOutcome& outcome, const common::Pose2& T_odom_body, common::Time now);
  bool isWithheld(const perception::ProjectedScan& scan);
  OdometryStep match(const perception::ProjectedScan& scan);
  bool fuse(const OdometryStep& step);
  void fuse(const AltitudeStep& step, common::Time stamp);
  Eigen::Matrix2d horizontalCovariance_m2() const;
  PositionFix positionFix(const OdometryStep& step, bool matched, const common::Pose2& T_odom_body,
                          const MapStep& map) const;
  void localize(const LocatedScan& located, common::Time now);
  void fuse(const CameraStep& step, common::Time now);
  void lookAtGround(const common::RgbdFrame& frame);
  void correctClimb(const perception::HeightDriftRate& drift, common::Time stamp);
  bool isCameraDoubted(common::Time now) const;
  void mapFrames(common::Time now);
  void mapFrame(common::Time now);
  void mapSweeps(common::Time now);
  std::optional<SweepSituation> situationAt(const VerticalLaserPipeline::Interval& times, common::Time now);
  void lookForTargets(common::Time now);
  FrameSituation situationAt(common::Time time, common::Time now);
  std::optional<common::KeyRelativePose> atKey(common::Time time) const;
  std::optional<BodyAtFrame> bodyAt(common::Time time) const;
  common::Pose3 T_odom_bodyAt(const perception::ProjectedScan& scan) const;
  void reportHealth(common::Time now);
  void say(common::Time now, common::Severity severity, std::string source, std::string text, std::string reason = {},
           common::Concern concern = common::Concern::kNone);

  bool uses_ahrs_;
  double standing_height_m_;  ///< Height of the body when standing, if the mirror sees no floor.
  perception::ErrorStateFilter filter_;
  perception::FilterListener* listener_ = nullptr;
  double explained_within_m_;  ///< Of the people tracker.
  perception::PeopleTracker people_;
  LaserPipeline laser_;
  StartView start_view_;
  AltitudePipeline altitude_;
  MapPipeline map_;
  StepUncertainty step_uncertainty_;
  DriftMonitor drift_;
  FlightLocalizerConfig localization_config_;
  common::JobRunner& jobs_;
  std::unique_ptr<FlightLocalizer> localizer_;             ///< Null if no map was given.
  std::unique_ptr<RgbdPipeline> rgbd_;                     ///< Null without a camera.
  std::unique_ptr<VerticalLaserPipeline> vertical_laser_;  ///< Null without one, and with a camera.
  std::unique_ptr<TargetPipeline> targets_;                ///< Null without a camera, and without targets to look for.

  std::optional<common::ImuSample> last_imu_;
  HorizonOffset horizon_;
  common::Time started_;        ///< Time at which the filter started.
  common::Time position_seen_;  ///< When the last scan that matched was processed.
  common::Time scanned_;        ///< The stamp of the last scan that was processed.
  common::Time ground_seen_;    ///< When the last image was taken that the slopes of the ground were taken from.
  std::optional<common::Time> camera_doubted_;  ///< When the beams down last contradicted the camera.
  common::Time map_seen_;  ///< When the last scan that matched was processed: it tells the place in the map.
  /// The frame `odom` as of the last scan relative to a key scan, once there is a map.
  std::optional<common::KeyRelativePose> odom_at_key_;
  double drift_m_ = 0.0;      ///< Of the last scan.
  common::Time height_seen_;  ///< When the last scan that measured the surface below was.
  bool at_flight_height_ = false;
  double below_map_m_ = 0.0;
  bool imu_seen_ = false;
  bool waiting_said_ = false;
  perception::FusionStatus last_health_ = perception::FusionStatus::kNotInitialized;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
