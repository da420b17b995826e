// Mount and clock of the RGB-D camera, estimated from key frame to key frame of a flight.
#pragma once

#include <optional>

#include "autonomy/estimation/frame_situation.hpp"
#include "common/event_log.hpp"
#include "common/key_pose.hpp"
#include "common/time.hpp"
#include "common/world/map3d_layer.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/camera_calibration.hpp"

namespace swiftlet::autonomy {

/// The body at a key frame.
struct BodyAtKeyFrame {
  common::Time stamp;  ///< Of the frame, by the camera's clock.
  common::KeyRelativePose at_key;
  BodyAtFrame body;
};

/// One thread.
class FrameCalibration {
 public:
  FrameCalibration(const mapping3d::CameraCalibrationConfig& config, const common::Pose3& T_body_camera_sheet,
                   common::EventLog& log)
      : calibration_(config, T_body_camera_sheet), log_(log) {}

  /// A new key frame: `body` is nullopt if its pose or motion is not known. True if the estimate has changed.
  bool add(const std::optional<BodyAtKeyFrame>& body, const mapping3d::RgbdPose& seen, const common::KeyPoses& keys,
           common::Time now);

  const mapping3d::CameraCalibration& calibration() const { return calibration_; }
  /// Mount and clock as they are used now, and how well they are known.
  common::CameraEstimate camera() const;

 private:
  void report(common::Time now);

  mapping3d::CameraCalibration calibration_;
  std::optional<BodyAtKeyFrame> key_frame_;  ///< The last one.
  bool mount_reported_ = false, clock_reported_ = false;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
