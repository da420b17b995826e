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
#include <utility>
#include <vector>

#include "autonomy/estimation/camera_steps.hpp"
#include "autonomy/estimation/frame_calibration.hpp"
#include "autonomy/estimation/frame_intake.hpp"
#include "autonomy/estimation/frame_situation.hpp"
#include "autonomy/estimation/map3d_publisher.hpp"
#include "autonomy/estimation/rgbd_pipeline_config.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/world/map3d_layer.hpp"
#include "mapping3d/model/mapper3d.hpp"

namespace swiftlet::autonomy {

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class RgbdPipeline {
 public:
  RgbdPipeline(const RgbdPipelineConfig& config, const common::RgbdCameraConfig& camera, common::JobRunner& jobs,
               common::EventLog& log);
  RgbdPipeline(const RgbdPipeline&) = delete;
  RgbdPipeline& operator=(const RgbdPipeline&) = delete;

  /// False for a frame that cannot be used: it is counted and left out.
  bool add(std::shared_ptr<const common::RgbdFrame> frame);
  /// Takes what has come, detects that the camera sends nothing usable, and fuses the submaps if it is time. To be
  /// called at every tick.
  void watch(const std::shared_ptr<const common::KeyPoses>& keys, common::Time now);

  /// The time at which the frame that is next to be mapped was measured; nullopt while there is no such frame, or while
  /// another one is being mapped.
  std::optional<common::Time> next() const;
  /// Until then it is worth waiting for a scan of its time. Only if there is a next one.
  common::Time waitUntil() const;
  /// Maps the next frame.
  void map(const FrameSituation& situation, common::Time now);
  /// Its measurements for the filter.
  CameraSteps& steps() { return steps_; }

  /// Mount and clock as they are used now, and how well they are known.
  common::CameraEstimate camera() const { return calibration_.camera(); }
  /// The layer with these key scans; null before the first frame. The same object until something changes.
  std::shared_ptr<const common::Map3dLayer> layer(const std::shared_ptr<const common::KeyPoses>& keys);
  RgbdCounts counts() const;
  /// nullopt without a radio.
  std::optional<mapping3d::RadioCounts> radioCounts() const { return intake_.radioCounts(); }

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
  void fetch();
  void take(Outcome outcome, common::Time delivered);
  common::Time timeOf(const common::RgbdFrame& frame) const;
  void measure(const Outcome& outcome, common::Time now);
  void reportTrack(bool tracked, common::Time now);

  common::Duration latency_;
  common::EventLog& log_;
  FrameIntake intake_;
  FrameCalibration calibration_;
  CameraSteps steps_;
  common::JobRunner& jobs_;
  std::shared_ptr<mapping3d::Mapper3d> mapper_;       ///< Belongs to the job while one is outstanding.
  std::shared_ptr<const common::RgbdFrame> waiting_;  ///< Null without one.
  Map3dPublisher publisher_;
  bool has_begun_ = false;  ///< The first frame was placed.
  common::Hysteresis lost_;
  std::uint64_t mapped_ = 0, lost_frames_ = 0;  ///< See RgbdCounts.
  int scan_ = 0;
  common::Pose3 T_scan_camera_;
};

}  // namespace swiftlet::autonomy
