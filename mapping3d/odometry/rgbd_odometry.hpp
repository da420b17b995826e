// The pose of an RGB-D camera against a persistent model of what it has seen (UNB's Algorithm 1, lines 1 to 3).
//
//              +------------- a frame fits: tracked, the model grows
//              v                  |
//   no model -> tracking ---------+
//                 |   ^
//       none fits |   | recognized by a key frame's points and confirmed by the alignment
//                 v   |
//                lost +
//
// While lost, the model does not change. Deterministic; one thread.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/key_frame_map.hpp"
#include "mapping3d/odometry/point_registration.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct RgbdOdometryConfig {
  int greatest_width_px = 320;
  int levels = 4;
  double least_agreement = 0.6;
  int least_points = 150;
  double least_correlation = 0.4;
  double acceleration_m_s2 = 5.0;
  double angular_acceleration_rad_s2 = 10.0;
  vision::FeatureConfig features;
  ReferenceConfig reference;
  AlignmentConfig alignment;
  KeyFrameConfig key_frames;
  PointRegistrationConfig recognition;

  void describe(common::config::Fields& fields);
};

enum class TrackState {
  kTracked,
  kFoundAgain,  ///< Tracked, after it was lost.
  kLost,        ///< The pose is only predicted.
};

struct RgbdPose {
  common::Time stamp;
  TrackState state = TrackState::kLost;
  common::Pose3 T_map_camera;
  /// Covariance of the error (x, y, z, rotation vector), in the axes of the camera; meaningless while lost.
  Matrix6d covariance = Matrix6d::Zero();
  Alignment fit;
  bool became_key_frame = false;

  bool isTracked() const { return state != TrackState::kLost; }
};

class RgbdOdometry {
 public:
  explicit RgbdOdometry(const RgbdOdometryConfig& config);

  /// Frames come in the order of their stamps. `T_seed_camera` is the pose that other sensors give at the frame's time,
  /// in any frame that moves little against the map: only its change since the last frame with a seed is used, and the
  /// first seed places the map.
  RgbdPose process(const common::RgbdFrame& frame, const std::optional<common::Pose3>& T_seed_camera = std::nullopt);

  const KeyFrameMap& keyFrames() const { return keys_; }

 private:
  struct Last {
    common::Time stamp;
    common::Pose3 T_map_camera;
    std::optional<common::Pose3> T_seed_camera;
    Exposure exposure;
    Eigen::Vector3d velocity_camera_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d rate_camera_rad_s = Eigen::Vector3d::Zero();
  };
  std::vector<common::Pose3> predictions(common::Time stamp, const std::optional<common::Pose3>& T_seed_camera) const;
  common::Pose3 bestOf(const std::vector<common::Pose3>& poses, const FramePyramid& pyramid) const;
  PosePrior motionPrior(common::Time stamp, const common::Pose3& predicted) const;
  std::optional<Alignment> tracked(const FramePyramid& pyramid, const PosePrior& prior,
                                   std::vector<std::size_t>& keys) const;
  std::optional<Alignment> recognized(const FramePyramid& pyramid, const std::vector<DescribedPoint>& points,
                                      std::vector<std::size_t>& keys);
  bool isGood(const Alignment& fit) const;
  void addKeyFrame(const RgbdPose& pose, const FramePyramid& pyramid, const std::vector<vision::Feature>& features);
  void remember(const RgbdPose& pose, const std::optional<common::Pose3>& T_seed_camera);

  RgbdOdometryConfig config_;
  KeyFrameMap keys_;
  std::optional<Last> last_;
  bool is_lost_ = false;
  std::size_t next_tried_ = 0;  ///< While lost, key frames are tried in turn.
  std::uint64_t frames_ = 0;
};

}  // namespace swiftlet::mapping3d
