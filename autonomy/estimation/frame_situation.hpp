// What the estimator knows at the time of a frame of the RGB-D camera.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "common/disc.hpp"
#include "common/key_pose.hpp"
#include "mapping3d/odometry/camera_calibration.hpp"

namespace swiftlet::autonomy {

/// The source of the events about frames and their map, and the name of its jobs.
inline constexpr const char* kMapping3d = "mapping3d";

/// How the body moves at the time of a frame.
struct BodyAtFrame {
  Eigen::Quaterniond R_odom_body;
  mapping3d::MovingBody motion;
};

struct FrameSituation {
  std::optional<common::KeyRelativePose> at_key;  ///< Pose of the body; nullopt if it is not known.
  std::optional<BodyAtFrame> body;                ///< Motion of the body; nullopt if it is not known.
  /// Whether a measurement has just supported the position, so that it is a pose in the map and not only predicted.
  bool supported = false;
  std::shared_ptr<const common::KeyPoses> keys;  ///< Never null.
  std::vector<common::Disc> people;
};

}  // namespace swiftlet::autonomy
