// Makes the 3D map from the frames of an RGB-D camera. The heavy work is a job, a function of the frame, its seed and
// the mapper's past.
//
//   frame --> waits until the pose at its time is known --> Mapper3d, a job --> Map3dLayer
//                 ^--- a newer frame replaces it       |         \--> all submaps fused, a job of its own
//                 \-- mount and clock <-- calibration <-/
//
// At most one frame is being mapped and one waits, so frames are left out where the work takes longer than the camera.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "autonomy/arrivals/silence_watch.hpp"
#include "autonomy/estimation/odometry_step.hpp"
#include "autonomy/estimation/rgbd_pipeline_config.hpp"
#include "common/disc.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/world/map3d_layer.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/camera_calibration.hpp"

namespace swiftlet::autonomy {

/// How the body moves at the time of a frame.
struct BodyAtFrame {
  Eigen::Quaterniond R_odom_body;
  mapping3d::MovingBody motion;
};

/// The estimator's data at the time of a frame.
struct FrameSituation {
  std::optional<common::KeyRelativePose> at_key;  ///< Pose of the body; nullopt if it is not known.
  std::optional<BodyAtFrame> body;                ///< Motion of the body; nullopt if it is not known.
  /// Whether a measurement has just supported the position, so that it is a pose in the map and not only predicted.
  bool supported = false;
  std::shared_ptr<const common::KeyPoses> keys;  ///< Never null.
  std::vector<common::Disc> people;
};

struct RgbdCounts {
  std::uint64_t frames = 0;  ///< Frames that arrived and could be used.
  /// Frames that are repeated (also as a picture with a new stamp), late, of the future, without images of the camera's
  /// size, or blank.
  std::uint64_t skipped = 0;
  std::uint64_t blank = 0;   ///< Skipped frames with a black or a white picture.
  std::uint64_t mapped = 0;  ///< Frames that were aligned to the map and drawn.
  std::uint64_t lost = 0;    ///< Frames that did not fit and were left out.
};

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class RgbdPipeline {
 public:
  RgbdPipeline(const RgbdPipelineConfig& config, const common::RgbdCameraConfig& camera, common::JobRunner& jobs);
  RgbdPipeline(const RgbdPipeline&) = delete;
  RgbdPipeline& operator=(const RgbdPipeline&) = delete;

  /// False for a frame that cannot be used: it is counted and left out.
  bool add(std::shared_ptr<const common::RgbdFrame> frame);

  /// The time at which the frame that is next to be mapped was measured; nullopt while there is no such frame, or while
  /// another one is being mapped.
  std::optional<common::Time> next() const;
  /// Until then it is worth waiting for a scan of its time. Only if there is a next one.
  common::Time waitUntil() const { return waiting_->stamps.arrived + common::Duration::fromSeconds(config_.wait_s); }
  /// Maps the next frame.
  void map(const FrameSituation& situation, common::Time now);
  /// The measurement of the last frame for the filter; nullopt if it was taken before, or without a new frame.
  std::optional<CameraStep> takeStep() { return std::exchange(step_, std::nullopt); }
  /// The filter no longer has the clone from which the measurements start.
  void forgetClone() { reference_.reset(); }
  /// Detects that the camera sends nothing usable, takes what has come over the radio, and fuses the submaps if it is
  /// time. To be called at every tick.
  void watch(const std::shared_ptr<const common::KeyPoses>& keys, common::Time now);

  /// Mount and clock as they are used now, and how well they are known.
  common::CameraEstimate camera() const;

  /// The layer with these key scans; null before the first frame. The same object until something changes.
  std::shared_ptr<const common::Map3dLayer> layer(const std::shared_ptr<const common::KeyPoses>& keys);
  const RgbdCounts& counts() const { return counts_; }
  /// nullopt without a radio.
  std::optional<mapping3d::RadioCounts> radioCounts() const {
    return radio_ ? std::optional(radio_->counts()) : std::nullopt;
  }
  std::vector<common::Event> takeEvents();

 private:
  /// The outcome of the job of a frame.
  struct Outcome {
    std::shared_ptr<const common::RgbdFrame> frame;
    common::Time time;                              ///< Time of the frame's pose.
    std::optional<common::KeyRelativePose> at_key;  ///< FrameSituation::at_key.
    std::optional<BodyAtFrame> body;                ///< FrameSituation::body.
    std::shared_ptr<const common::KeyPoses> scans;
    mapping3d::MappedFrame mapped;
    std::optional<std::vector<common::Submap3d>> submaps;  ///< If they were to be published.
  };
  void take(Outcome outcome, common::Time delivered);
  const char* faultOf(const common::RgbdFrame& frame);
  void skip(const char* fault, common::Time now);
  common::Time timeOf(const common::RgbdFrame& frame) const;
  CameraStep stepOf(const Outcome& outcome);
  void calibrate(const Outcome& outcome, common::Time now);
  void reportCamera(common::Time now);
  void watchRadio(common::Time now);
  void reportTrack(bool tracked, common::Time now);
  void say(common::Time now, common::Severity severity, std::string text, std::string reason = {});
  void keep(std::optional<common::Event> event);

  RgbdPipelineConfig config_;
  mapping3d::CameraCalibration calibration_;
  bool mount_said_ = false, clock_said_ = false;
  bool has_noise_;  ///< By the data sheet; otherwise equal pictures are right ones while nothing moves.
  SilenceWatch silence_;
  common::JobRunner& jobs_;
  std::shared_ptr<mapping3d::Mapper3d> mapper_;  ///< Belongs to the job while one is outstanding.

  std::optional<mapping3d::RadioLink> radio_;
  std::shared_ptr<const common::RgbdFrame> waiting_;  ///< Null without one.
  std::shared_ptr<const common::RgbdFrame> last_;     ///< The last usable one; null before it.
  bool has_begun_ = false;                            ///< The first frame was placed.
  bool lost_said_ = false;
  std::set<std::string> faults_said_;
  std::optional<common::Time> through_at_;  ///< When a frame last came through the radio.
  bool stuck_said_ = false;                 ///< An event has said that no frame comes through the radio.
  int most_halvings_ = 0;                   ///< Most halvings of frames that an event has reported.
  std::optional<common::Time> lost_since_;

  Map3dPublisher publisher_;
  int scan_ = 0;
  common::Pose3 T_scan_camera_;
  /// The frame from which measurements start. A key frame, or the first tracked frame after the clone was dropped.
  struct Reference {
    common::Time time;
    int scan = 0;
    common::Pose3 T_scan_camera;
    mapping3d::MovingBody motion;
  };
  /// The body at the last key frame, from which the calibration measures.
  struct BodyAtKeyFrame {
    common::Time stamp;
    common::KeyRelativePose at_key;
    BodyAtFrame body;
  };
  std::optional<BodyAtKeyFrame> key_frame_;
  std::optional<Reference> reference_;
  std::optional<CameraStep> step_;
  RgbdCounts counts_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
