// The sensors of the third dimension, an RGB-D camera or else an upright laser: each frame and sweep waits until the
// pose of its own time is known, then makes the 3D map; in frames coloured targets are looked for too, and what
// the profile names is recognized. Pairs of a stereo camera measure the motion, make the 3D map, and show patterns.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "autonomy/estimation/odometry_step.hpp"
#include "autonomy/estimation/pose_track.hpp"
#include "autonomy/estimation/recognition_pipeline.hpp"
#include "autonomy/estimation/rgbd_pipeline.hpp"
#include "autonomy/estimation/stereo_map.hpp"
#include "autonomy/estimation/stereo_pipeline.hpp"
#include "autonomy/estimation/target_pipeline.hpp"
#include "autonomy/estimation/vertical_laser_pipeline.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle_config.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "perception/people/people_tracker.hpp"

namespace swiftlet::autonomy {

/// Further data of the estimator at a tick.
struct MapSituation {
  const PoseTrack& poses;
  std::shared_ptr<const common::KeyPoses> keys;  ///< Never null.
  const perception::PeopleTracker& people;
  double drift_m = 0.0;  ///< See DriftMonitor.
  common::PlaceNames names;
  std::shared_ptr<const common::OccupancyGrid> grid = nullptr;  ///< Null unless something is recognized.
};

/// One thread. Its jobs refer to it.
class SpaceSensors {
 public:
  struct Config {
    const RgbdPipelineConfig& rgbd;
    const VerticalLaserPipelineConfig& vertical_laser;
    const TargetPipelineConfig& targets;
    const std::vector<perception::KnownObjectConfig>& recognition;
    const common::LaserConfig& laser;  ///< Data sheet of the level laser.
  };
  /// Data sheets; null without that sensor. With a camera an upright laser is not used.
  SpaceSensors(const Config& config, const common::RgbdCameraConfig* camera, const common::LaserConfig* vertical_laser,
               common::JobRunner& jobs, common::EventLog& log);

  /// Whether the frame can be used; false without a camera, and for a pair of a stereo camera, which has no depths yet.
  [[nodiscard]] bool add(std::shared_ptr<const common::RgbdFrame> frame);
  /// Without an upright laser the sweep is ignored.
  void add(std::shared_ptr<const common::VerticalScan> sweep);
  /// A scan of the level laser, for what is recognized.
  void add(const common::LaserScan& scan) {
    if (recognition_) recognition_->add(scan);
  }

  bool hasCamera() const { return rgbd_ || stereo_; }
  /// Mount and clock; only with an RGB-D camera.
  common::CameraEstimate camera() const { return rgbd_->camera(); }
  /// The measurement of the camera for the filter, at every tick before `map`; nullopt without a new one.
  std::optional<CameraStep> takeStep(const std::shared_ptr<const common::KeyPoses>& keys, common::Time now);
  /// What the beams down measured, for a stereo camera; see StereoScale::addBeams.
  void addBeams(common::Time stamp, double below_m, const Eigen::Quaterniond& R_level_body) {
    if (stereo_) stereo_->addBeams(stamp, below_m, R_level_body);
  }
  /// See CameraSteps::forgetClone.
  void forgetClone();
  /// Something contradicted the camera then: its measurements are not used for kCameraDoubted_s.
  void doubtCamera(common::Time now) { camera_doubted_ = now; }
  bool isCameraDoubted(common::Time now) const {
    return camera_doubted_ && (now - *camera_doubted_).seconds() < kCameraDoubted_s;
  }
  /// The filter was told what the camera measured then, and knows the horizontal position by it.
  void placedByStereo(common::Time now) {
    if (stereo_) placed_ = now;
  }
  /// Whether the last pair of a stereo camera that measured the position is not older than that.
  bool isPlacedByStereo(common::Time now) const { return placed_ && (now - *placed_).seconds() <= kStereoPlaces_s; }
  /// Longer than it takes the camera to be matched anew.
  static constexpr double kCameraDoubted_s = 1.0;
  /// Maps what has waited long enough, at every tick.
  void map(const MapSituation& situation, common::Time now);

  /// Null before the first frame or sweep.
  std::shared_ptr<const common::Map3dLayer> layer(const std::shared_ptr<const common::KeyPoses>& keys);
  std::vector<common::Target> targets(const common::KeyPoses& keys) const;
  bool recognizes() const { return recognition_ != nullptr; }
  /// Null unless something is recognized.
  std::shared_ptr<const common::ObjectsLayer> objects(const common::KeyPoses& keys) const;
  /// nullopt without a camera.
  std::optional<RgbdCounts> counts() const { return rgbd_ ? std::optional(rgbd_->counts()) : std::nullopt; }
  /// nullopt without a camera whose frames come over a radio.
  std::optional<mapping3d::RadioCounts> radioCounts() const { return rgbd_ ? rgbd_->radioCounts() : std::nullopt; }

 private:
  /// Two pairs at 3 Hz, the slowest that is flown: for so long the filter carries the position from the last one.
  static constexpr double kStereoPlaces_s = 0.7;
  static FrameSituation situationAt(common::Time time, const MapSituation& situation, common::Time now);
  void mapFrame(const MapSituation& situation, common::Time now);
  void mapPair(const MapSituation& situation, common::Time now);
  void lookForTargets(const MapSituation& situation, common::Time now);
  void recognize(const MapSituation& situation, common::Time now);
  common::CameraEstimate anyCamera() const;
  void mapSweeps(const MapSituation& situation, common::Time now);

  std::unique_ptr<RgbdPipeline> rgbd_;                     ///< Null without a camera, and with a stereo camera.
  std::unique_ptr<StereoPipeline> stereo_;                 ///< Null without a stereo camera.
  std::unique_ptr<StereoMap> stereo_map_;                  ///< Likewise.
  std::unique_ptr<VerticalLaserPipeline> vertical_laser_;  ///< Null without one, and with a camera.
  std::unique_ptr<TargetPipeline> targets_;  ///< Null without an RGB-D camera, and without targets to look for.
  std::unique_ptr<RecognitionPipeline> recognition_;  ///< Null without a camera, and without anything to recognize.
  std::optional<common::Time> camera_doubted_;
  std::optional<common::Time> placed_;  ///< See placedByStereo.
};

}  // namespace swiftlet::autonomy
