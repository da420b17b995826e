// The 3D SLAM of Saeedi et al., section III-C, Algorithm 1, as published: the model consists of corners.
//
//   1  m  = getFeatures(F)                   corners of Shi and Tomasi, each a Gaussian in space (vision/features.hpp)
//   2  m' = transform(m, p, roll, pitch, z)  from the seed: 2D SLAM, attitude and height (camera_seed.hpp)
//   3  M  = match(m', M)                     ICP to the landmarks; those that match are updated, the others added
//   4  M  = bundleAdjustment(M)              local: of the newest key frames and the landmarks that they see
//
// The state machine is that of RgbdOdometry. Algorithm 1 leaves open what happens without a seed and after a loss. Then
// line 2 extrapolates the motion, and a key frame that looks alike finds the place again. The adjustment moves the
// landmarks and the newest key frame; older key frames keep the pose on which frames and submaps hang already, and move
// with the pose graph, which closes the loops.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "common/key_pose.hpp"
#include "mapping3d/landmarks/landmark_icp.hpp"
#include "mapping3d/landmarks/landmark_model.hpp"
#include "mapping3d/odometry/frame_odometry.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

/// Deterministic; one thread.
class ModelIcp final : public FrameOdometry {
 public:
  explicit ModelIcp(const vision::FeatureConfig& features) : features_(features) {}

  void moveTo(std::shared_ptr<const common::KeyPoses> scans) override;
  /// The first frame with enough features places the map; those before it are lost.
  RgbdPose process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed = std::nullopt,
                   common::Duration depth_later = {}) override;
  void hang(std::size_t key, int scan) override;
  void joinTracks(int from, int into) override { keys_.joinTracks(from, into); }
  const KeyFrameMap& keyFrames() const override { return keys_; }
  const FramePyramid& pyramid() const override { return pyramid_; }
  const LandmarkModel& landmarks() const { return model_; }

 private:
  using Features = std::vector<vision::Feature>;
  struct Observation {
    std::uint64_t landmark = 0;  ///< Its number.
    std::size_t feature = 0;     ///< Index into the key frame's.
  };
  /// A key frame of the adjustment.
  struct Adjusted {
    common::Pose3 T_map_key;
    int scan = 0;
    std::optional<CameraSeed> seed;
    Features features;
    std::vector<Observation> seen;
  };
  struct Fit {
    ModelMatch match;
    PosePrior prior;
    std::vector<Landmark> landmarks;  ///< To which the match refers.
  };
  PosePrior predicted(common::Time stamp, const std::optional<CameraSeed>& seed) const;
  Fit matched(const Features& features, const common::PinholeCamera& camera, const PosePrior& prior) const;
  std::optional<Fit> findPose(const Features& features, const FramePyramid& pyramid, common::Time stamp,
                              const PosePrior& prior, const std::optional<CameraSeed>& seed) const;
  void begin(RgbdPose& pose, Features features, const FramePyramid& pyramid, const std::optional<CameraSeed>& seed);
  void take(const Fit& fit, RgbdPose& pose, Features features, const FramePyramid& pyramid,
            const std::optional<CameraSeed>& seed);
  std::optional<KeyFrameMotion> motionSinceKeyFrame(const Features& features, const common::Pose3& T_map_camera) const;
  std::vector<Observation> learn(const Fit& fit, const RgbdPose& pose, const Features& features);
  void addKeyFrame(RgbdPose& pose, KeyFramePlace place, const FramePyramid& pyramid, Adjusted adjusted);
  void adjustBundle();

  vision::FeatureConfig features_;
  KeyFrameMap keys_;
  LandmarkModel model_;
  std::deque<Adjusted> adjusted_;  ///< The newest key frames, the oldest of them first.
  std::shared_ptr<const common::KeyPoses> scans_;
  std::optional<LastFrame> last_;
  FramePyramid pyramid_;
  int tracks_ = 0;        ///< How often the model restarted.
  int unfit_frames_ = 0;  ///< Number of consecutive ones up to the last frame; while there are any it is lost.
  std::uint64_t frames_ = 0;
};

}  // namespace swiftlet::mapping3d
