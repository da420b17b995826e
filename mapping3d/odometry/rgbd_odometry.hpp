// The pose of an RGB-D camera against a persistent model of what it has seen: its key frames, to which frames are
// aligned directly (decision 032). The model is persistent as in Saeedi's Algorithm 1; features only recognize a place.
//
//              +------------- a frame fits: tracked, the model grows
//              v                  |
//   no model -> tracking ---------+
//                 |   ^
//       none fits |   | recognized by a key frame's points and confirmed by the alignment,
//                 v   | or aligned from the last pose, for a second
//                lost +
//
// The first frame with enough surfaces makes the model. While lost, it does not change, unless seeds in the map tell
// where the camera is: then key frames restart there. Deterministic; one thread.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/camera_seed.hpp"
#include "mapping3d/odometry/key_frame_map.hpp"
#include "mapping3d/odometry/measured_pose.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct RgbdOdometryConfig {
  vision::FeatureConfig features;
  AlignmentConfig alignment;

  void describe(common::config::Fields& fields);
};

/// Whether an aligned frame agrees with its key frames, as far as the frame itself can show.
bool isGoodFit(const Alignment& fit);

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

  bool isTracked() const { return state != TrackState::kLost; }
};

class RgbdOdometry {
 public:
  explicit RgbdOdometry(const RgbdOdometryConfig& config) : config_(config) {}

  /// Moves the model with the key scans of the 2D map. Where there are any, it must be called before the first frame.
  void moveTo(std::shared_ptr<const common::KeyPoses> scans);

  /// Frames come in the order of their stamps. The seed is what other sensors give at the frame's time. The first frame
  /// with enough surfaces places the map; those before it are lost.
  RgbdPose process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed = std::nullopt);

  /// For a frame that just became a key frame: it, and the frames after it, hang on this key scan.
  void hangNewestOn(int scan);

  const KeyFrameMap& keyFrames() const { return keys_; }

 private:
  struct Last {
    common::Time stamp;
    common::Pose3 T_map_camera;
    Matrix6d covariance;  ///< With the axes of the camera.
    int scan = 0;
    std::optional<CameraSeed> seed;
    Exposure exposure;
    Eigen::Vector3d velocity_camera_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d rate_camera_rad_s = Eigen::Vector3d::Zero();
  };
  struct Fit {
    Alignment alignment;
    PosePrior prior;
    std::vector<std::size_t> keys;  ///< The key frames it was aligned to, the best first.
  };
  std::vector<common::Pose3> predictions(common::Time stamp, const std::optional<CameraSeed>& seed) const;
  common::Pose3 bestOf(const std::vector<common::Pose3>& poses, const FramePyramid& pyramid) const;
  PosePrior motionPrior(common::Time stamp, const common::Pose3& predicted) const;
  PosePrior predicted(const FramePyramid& pyramid, common::Time stamp, const std::optional<CameraSeed>& seed) const;
  std::optional<Fit> findPose(const FramePyramid& pyramid, const PosePrior& prior, common::Time stamp,
                              const std::optional<CameraSeed>& seed);
  std::optional<Fit> tracked(const FramePyramid& pyramid, const PosePrior& prior,
                             const std::optional<CameraSeed>& seed) const;
  std::optional<Fit> recognized(const FramePyramid& pyramid, common::Time stamp, const std::optional<CameraSeed>& seed);
  bool isGood(const Alignment& fit, const std::optional<CameraSeed>& seed) const;
  bool canBegin(const FramePyramid& pyramid) const;
  void begin(RgbdPose& pose, const FramePyramid& pyramid, const std::optional<CameraSeed>& seed);
  void take(const Fit& fit, RgbdPose& pose, const FramePyramid& pyramid, const std::optional<CameraSeed>& seed);
  std::optional<KeyFrameMotion> motionSinceKeyFrame(const Fit& fit, const FramePyramid& pyramid,
                                                    double gradient_variance) const;
  KeyFramePlace newPlace(const Fit& fit, const RgbdPose& pose, const std::optional<CameraSeed>& seed) const;
  void lose(RgbdPose& pose, const FramePyramid& pyramid, const std::optional<CameraSeed>& seed);
  void addKeyFrame(const RgbdPose& pose, const KeyFramePlace& place, const FramePyramid& pyramid);
  void remember(const RgbdPose& pose, const std::optional<CameraSeed>& seed);

  RgbdOdometryConfig config_;
  KeyFrameMap keys_;
  std::optional<Last> last_;
  std::uint64_t scans_version_ = 0;
  bool is_lost_ = false;
  int unfit_frames_ = 0;  ///< Number of consecutive ones up to the last frame.
  int tracks_ = 0;        ///< How often key frames restarted.
  std::uint64_t frames_ = 0;
};

}  // namespace swiftlet::mapping3d
