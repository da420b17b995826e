// Visual odometry: the motion of a camera with depths since a key frame, by corners that both show (Tomic 2012, "Visual
// Odometry").
//
//   frame --> corners with depth and covariance --> for each key frame of the buffer: alike corners, consensus,
//   ellipsoid error --> the motion of the least covariance
//
// Of the key frames in the buffer that one counts whose motion has the least covariance, so that the error does not
// grow while the camera hovers. Corners are first looked for where the camera's own last motion leads, since the
// patterns of floors repeat themselves, then everywhere. No other sensor is asked: what is measured is independent of
// what the filter predicts.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/message.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "perception/visual_odometry/gaussian_registration.hpp"
#include "vision/features.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::perception {

/// The motion of the camera since a key frame.
struct VisualMotion {
  common::Time from, to;  ///< Stamps of the key frame and of the frame.
  common::Pose3 T_from_to;
  /// Of the error (position, rotation vector) with the axes of the camera at `to`.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  int pairs = 0;  ///< Corners of both on which it rests.
};

struct VisualStep {
  common::Time stamp;
  std::optional<VisualMotion> motion;
  /// Why there is no motion; without a name for the first frame, which has no other to compare with.
  common::Message missing;
  bool became_key_frame = false;
};

/// One thread. Deterministic: a function of the frames.
class VisualOdometry {
 public:
  /// The key frames of the buffer. The filter clones the pose of each, and keeps four clones, one of them the laser's.
  static constexpr std::size_t kKeyFrames = 3;

  explicit VisualOdometry(const vision::DepthNoiseConfig& noise);

  /// Frames come in the order of their stamps.
  VisualStep add(const common::RgbdFrame& frame);
  /// Empties the buffer: nothing is measured from these key frames any more.
  void forget() { keys_.clear(); }

 private:
  /// Corners of a frame that can be recognized, with the places of these in the same order.
  struct Seen {
    common::Time stamp;
    std::vector<vision::DescribedPoint> described;
    std::vector<vision::GaussianPoint> points;
  };
  struct KeyFrame {
    std::shared_ptr<const Seen> seen;
    common::Pose3 T_start_camera;
    int most_pairs = 0;  ///< That a later frame has had with it.
  };
  /// Where the odometry takes the camera for, from its first frame on, and how it moves, in its own axes.
  struct Track {
    common::Time stamp;
    common::Pose3 T_start_camera;
    Eigen::Vector3d velocity_camera_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d rate_camera_rad_s = Eigen::Vector3d::Zero();

    common::Pose3 at(common::Time time) const;
    void moveTo(const common::Pose3& T_start_now, common::Time time);
  };
  Seen look(const common::RgbdFrame& frame, common::Message& missing) const;
  std::optional<VisualMotion> motionSince(const KeyFrame& key, const Seen& seen,
                                          const common::Pose3& T_start_camera) const;
  bool isWorthKeeping(const std::optional<VisualMotion>& motion, const KeyFrame* by) const;

  vision::FeatureConfig features_;
  vision::Agreement agreement_;
  std::deque<KeyFrame> keys_;  ///< The oldest first.
  std::optional<Track> track_;
};

/// The standard deviation of a motion in metres: of its least certain direction, with a turn counted as what it moves
/// at 1 m. Rows of the covariance: position, then rotation.
double deviation_m(const Eigen::Matrix<double, 6, 6>& covariance);

}  // namespace swiftlet::perception
