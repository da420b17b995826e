// The pose of an RGB-D camera against a persistent model of what it has seen: its key frames, to which frames are
// aligned directly (docs/decisions/mapping3d.md#032). The model is persistent as in Saeedi's Algorithm 1. The alignment
// begins where matched corners say that the camera is, which holds over steps of 20 degrees; then where its motion and
// its last pose say so.
//
//              +------------- a frame fits: tracked, the model grows
//              v                  |
//   no model -> tracking ---------+
//                 |   ^
//       none fits |   | recognized by a key frame's points and confirmed by the alignment,
//                 v   | or aligned from the last pose, for a second
//                lost +
//                 |   ^
//                 +---+ the next frame fits the lost one: both begin a new piece of the map
//
// The first frame with enough surfaces makes the model. Where nothing else says where the camera is, a lost one begins
// a new piece at once; its place is a guess, until a key frame of it is aligned to one of another piece (Atlas: C.
// Campos et al., "ORB-SLAM3", T-RO 2021, section VI). Elsewhere the model does not change while lost, unless seeds in
// the map tell where the camera is: then key frames restart there. Deterministic; one thread.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
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
  /// A lost camera begins a new piece of the map. Whoever sets it joins the pieces.
  bool begins_pieces = false;
  vision::FeatureConfig features;
  AlignmentConfig alignment;

  void describe(common::config::Fields& fields);
};

/// Whether an aligned frame agrees with its key frames, as far as the frame itself can show.
bool isGoodFit(const Alignment& fit);

/// A frame that is to be placed, beside its pyramid.
struct SeenFrame {
  common::Time stamp;
  std::optional<CameraSeed> seed;
  std::vector<DescribedPoint> corners;  ///< Empty where a seed in the map says where the alignment begins.
};

class RgbdOdometry final : public FrameOdometry {
 public:
  explicit RgbdOdometry(const RgbdOdometryConfig& config) : config_(config) {}

  void moveTo(std::shared_ptr<const common::KeyPoses> scans) override;
  /// The first frame with enough surfaces places the map; those before it are lost.
  RgbdPose process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed = std::nullopt,
                   common::Duration depth_later = {}) override;
  void hang(std::size_t key, int scan) override;
  void joinTracks(int from, int into) override;
  const KeyFrameMap& keyFrames() const override { return keys_; }
  const FramePyramid& pyramid() const override { return pyramid_; }

 private:
  struct Fit {
    Alignment alignment;
    PosePrior prior;
    std::vector<std::size_t> keys;  ///< The key frames it was aligned to, the best first.
    bool is_confirmed = false;      ///< By something else than the fit itself.
  };
  std::optional<common::Pose3> poseByCorners(const SeenFrame& frame) const;
  std::vector<common::Pose3> predictions(const SeenFrame& frame) const;
  common::Pose3 bestOf(const std::vector<common::Pose3>& poses) const;
  PosePrior motionPrior(common::Time stamp, const common::Pose3& predicted) const;
  PosePrior predicted(const SeenFrame& frame) const;
  common::Pose3 moveDepthToColor(const SeenFrame& frame, const std::optional<common::Pose3>& by_corners,
                                 common::Duration depth_later);
  std::optional<Fit> findPose(const SeenFrame& frame, const PosePrior& prior,
                              const std::optional<common::Pose3>& by_corners) const;
  std::optional<Fit> goneOn(const SeenFrame& frame, const PosePrior& prior,
                            const std::optional<common::Pose3>& by_corners) const;
  std::optional<Fit> tracked(const SeenFrame& frame, const PosePrior& prior,
                             const std::optional<common::Pose3>& by_corners, std::optional<int> track) const;
  std::optional<Fit> recognized(const SeenFrame& frame) const;
  std::optional<Fit> alignedToLostFrame(const SeenFrame& frame) const;
  bool isGood(const Alignment& fit, const std::optional<CameraSeed>& seed) const;
  std::optional<int> track() const { return config_.begins_pieces ? std::optional(track_) : std::nullopt; }
  bool canBegin() const;
  void begin(RgbdPose& pose, const SeenFrame& frame);
  void beginPiece(Fit fit, RgbdPose& pose, const SeenFrame& frame);
  void take(const Fit& fit, RgbdPose& pose, const SeenFrame& frame);
  std::optional<KeyFrameMotion> motionSinceKeyFrame(const Fit& fit, double gradient_variance) const;
  KeyFramePlace newPlace(const Fit& fit, const RgbdPose& pose, const std::optional<CameraSeed>& seed) const;
  void lose(RgbdPose& pose, const SeenFrame& frame);
  std::shared_ptr<const KeyFrame> keyFrameOf(common::Time stamp, const Exposure& exposure) const;

  RgbdOdometryConfig config_;
  KeyFrameMap keys_;
  FramePyramid pyramid_;
  std::optional<LastFrame> last_;
  std::shared_ptr<const KeyFrame> lost_frame_;  ///< The newest, with which a piece may begin; null while tracked.
  std::uint64_t scans_version_ = 0;
  bool is_lost_ = false;
  int unfit_frames_ = 0;        ///< Number of consecutive ones up to the last frame.
  int unconfirmed_frames_ = 0;  ///< The newest tracked ones, whose poses only their fits support.
  int track_ = 0;               ///< Of the newest frame.
  int tracks_ = 0;              ///< How often key frames restarted.
  std::uint64_t frames_ = 0;
};

}  // namespace swiftlet::mapping3d
