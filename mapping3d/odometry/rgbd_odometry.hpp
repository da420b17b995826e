// The pose of an RGB-D camera against a persistent model of what it has seen: its key frames, to which frames are
// aligned directly (docs/decisions/mapping3d.md#032). The model is persistent as in Saeedi's Algorithm 1; features only
// recognize a place.
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
#include "mapping3d/odometry/frame_odometry.hpp"
#include "mapping3d/odometry/key_frame_map.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct RgbdOdometryConfig {
  /// How the pose of a frame is found.
  enum class Method {
    kDirect,    ///< Aligned to key frames: RgbdOdometry.
    kModelIcp,  ///< Corners matched to landmarks: ModelIcp.
  };

  Method method = Method::kDirect;
  vision::FeatureConfig features;
  AlignmentConfig alignment;

  void describe(common::config::Fields& fields);
};

/// Whether an aligned frame agrees with its key frames, as far as the frame itself can show.
bool isGoodFit(const Alignment& fit);

class RgbdOdometry final : public FrameOdometry {
 public:
  explicit RgbdOdometry(const RgbdOdometryConfig& config) : config_(config) {}

  void moveTo(std::shared_ptr<const common::KeyPoses> scans) override;
  /// The first frame with enough surfaces places the map; those before it are lost.
  RgbdPose process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed = std::nullopt) override;
  void hangNewestOn(int scan) override;
  const KeyFrameMap& keyFrames() const override { return keys_; }

 private:
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

  RgbdOdometryConfig config_;
  KeyFrameMap keys_;
  std::optional<LastFrame> last_;
  std::uint64_t scans_version_ = 0;
  bool is_lost_ = false;
  int unfit_frames_ = 0;  ///< Number of consecutive ones up to the last frame.
  int tracks_ = 0;        ///< How often key frames restarted.
  std::uint64_t frames_ = 0;
};

}  // namespace swiftlet::mapping3d
