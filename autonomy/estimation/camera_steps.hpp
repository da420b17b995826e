// The measurements of the RGB-D camera for the filter: the motion since a reference frame whose pose the filter keeps.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "autonomy/estimation/odometry_step.hpp"
#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/time.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/camera_calibration.hpp"

namespace swiftlet::autonomy {

/// One thread.
class CameraSteps {
 public:
  /// A tracked frame whose pose is that of `time`, by the flight's clock.
  void add(common::Time time, const mapping3d::MovingBody& body, const mapping3d::MappedFrame& mapped,
           const common::KeyPoses& keys, const mapping3d::CameraCalibration& calibration);
  /// A tracked frame at whose time the motion of the body is not known: it measures nothing.
  void addUnplaced() { step_ = CameraStep{}; }
  /// The measurement of the last frame; nullopt if it was taken before, or without a new frame.
  std::optional<CameraStep> take() { return std::exchange(step_, std::nullopt); }
  /// The filter no longer has the clone from which the measurements start.
  void forgetClone() { reference_.reset(); }

 private:
  /// The frame from which measurements start. A key frame, or the first tracked frame after the clone was dropped.
  struct Reference {
    common::Time time;
    int scan = 0;
    common::Pose3 T_scan_camera;
    mapping3d::MovingBody motion;
  };

  std::optional<Reference> reference_;
  std::optional<CameraStep> step_;
};

}  // namespace swiftlet::autonomy
