// The pose of each frame of an RGB-D camera in a map that grows with the frames, whatever the method.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/camera_seed.hpp"
#include "mapping3d/odometry/key_frame_map.hpp"
#include "mapping3d/odometry/measured_pose.hpp"
#include "mapping3d/odometry/motion_prior.hpp"

namespace swiftlet::mapping3d {

enum class TrackState {
  kTracked,
  kFoundAgain,  ///< Tracked, after it was lost.
  kLost,        ///< The pose is only predicted, or that of the seed.
};

/// The motion since a key frame, aligned to that one alone and without a prior: measured by the pictures alone.
struct KeyFrameMotion {
  common::Time from;  ///< The key frame's stamp.
  common::Pose3 T_from_to;
  /// Of the error (x, y, z, rotation vector) in the axes of the camera at the end.
  Matrix6d covariance = Matrix6d::Identity();
};

struct RgbdPose {
  common::Time stamp;
  TrackState state = TrackState::kLost;
  common::Pose3 T_map_camera;
  common::Pose3 T_color_depth;  ///< Where the depth was taken, seen from T_map_camera.
  /// Covariance of the error (x, y, z, rotation vector), in the axes of the camera; meaningless while lost.
  Matrix6d covariance = Matrix6d::Zero();
  int scan = 0;  ///< The key scan next to it; see CameraSeed.
  /// The pose as the frame alone measures it; nullopt if it was not aligned.
  std::optional<MeasuredPose> measured;
  /// Of a frame that became a key frame: the motion since the one before. nullopt without overlap, or if there is
  /// too little texture.
  std::optional<KeyFrameMotion> motion;
  Alignment fit;
  /// The key scans on which the key frames hang that it was aligned to, the best first.
  std::vector<int> aligned_to;
  bool became_key_frame = false;
  /// The frame begins a piece of the map: the key frame before it became the first one of the piece. Where the piece
  /// lies is not known.
  bool begins_piece = false;
  /// While lost: how many of the frames just before the loss are doubted, because nothing confirmed their poses.
  int doubted = 0;

  bool isTracked() const { return state != TrackState::kLost; }
};

/// What the pose of the next frame is predicted from.
struct LastFrame {
  common::Time stamp;
  common::Pose3 T_map_camera;
  Matrix6d covariance;  ///< With the axes of the camera.
  int scan = 0;
  std::optional<CameraSeed> seed;
  Exposure exposure;                    ///< Of an odometry that aligns frames.
  CameraVelocity motion;                ///< Zero unless it was tracked after the frame before it.
  std::vector<DescribedPoint> corners;  ///< Of an odometry that begins with them.

  LastFrame(const RgbdPose& pose, const std::optional<CameraSeed>& its_seed, const std::optional<LastFrame>& before);
};

/// A function of its calls; one thread.
class FrameOdometry {
 public:
  virtual ~FrameOdometry() = default;

  /// Moves the model with the key scans of the 2D map. Where there are any, it must be called before the first frame.
  virtual void moveTo(std::shared_ptr<const common::KeyPoses> scans) = 0;

  /// Frames come in the order of their stamps. The seed is what other sensors give at the frame's time. The depth may
  /// have been taken later than the colour, whose time is the frame's.
  virtual RgbdPose process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed,
                           common::Duration depth_later) = 0;

  /// For a key frame that the newest frame has added, by its index: it, and the frames after it, hang on this key scan.
  virtual void hang(std::size_t key, int scan) = 0;
  /// Two pieces of the map have one frame of reference from now on: the track `from` is a part of `into`.
  virtual void joinTracks(int from, int into) = 0;

  virtual const KeyFrameMap& keyFrames() const = 0;
  /// The newest frame, as it was aligned. Empty before the first.
  virtual const FramePyramid& pyramid() const = 0;
};

}  // namespace swiftlet::mapping3d
