// Whether the depths of a stereo camera agree with the beams down: a wrong base or focal length scales all of them, and
// the motions that follow from them, while the rows of the pictures still agree.
//
//   pair --> points near the foot of the beams --> height of the camera over them / height by the beams --> median
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/message.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// What lies below the body by the depths of a frame, in the body's frame: within 0.3 m of the vertical through its
/// origin, on a grid of pixels.
std::vector<Eigen::Vector3f> pointsBelow_body_m(const common::RgbdFrame& frame, const common::Pose3& T_body_camera);

/// One thread. Plain data.
class StereoScale {
 public:
  explicit StereoScale(const common::Pose3& T_body_camera) : camera_body_m_(T_body_camera.position_m) {}

  /// The beams measured that the body's origin is so high over what is below, with the body turned so in a level frame.
  void addBeams(common::Time stamp, double below_m, const Eigen::Quaterniond& R_level_body);
  /// What a pair of that time shows below, see pointsBelow_body_m. Without beams of about that time it tells nothing.
  void addPair(common::Time stamp, const std::vector<Eigen::Vector3f>& points_body_m);

  /// Depths as measured over true ones, the median of the last pairs; nullopt with too few of them.
  std::optional<double> scale() const;
  /// Why the pairs do not agree with the beams; nullopt if they do, and while too little is known.
  std::optional<common::Message> contradiction() const;

 private:
  struct Beams {
    common::Time stamp;
    double below_m = 0.0;
    Eigen::Quaterniond R_level_body;
  };

  Eigen::Vector3d camera_body_m_;
  std::deque<Beams> beams_;      ///< Of the last kRemembered_s.
  std::deque<double> measured_;  ///< Of the last pairs.
};

}  // namespace swiftlet::autonomy
