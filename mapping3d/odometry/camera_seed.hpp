// The camera's pose by other sensors, where Saeedi's Algorithm 1 begins (its line 2), and how it keeps frames
// and key frames near the 2D map.
//
// A bare wall does not constrain the motion along it. There the frames follow the motion of the seeds, which is known
// much better than their place. From key frame to key frame the errors of the alignment add up, so that a 3D map of its
// own would leave the 2D map, whose loop closures correct it. Each new key frame is therefore placed by a Kalman
// update: the alignment predicts its pose, with an uncertainty that grew since the last seed, and the seed measures it.
#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/key_frame_map.hpp"

namespace swiftlet::mapping3d {

/// The pose of the camera at a frame's time.
struct CameraSeed {
  common::Pose3 T_map_camera;
  int scan = 0;  ///< The key scan on which a key frame that is made here hangs.
  /// Whether it is a pose in the map, to which the key frames then keep. Otherwise only its change since the last frame
  /// is used.
  bool is_in_map = true;
  /// Of a seed that is not in the map: covariance of the velocity and the angular rate that its steps have, per squared
  /// second, with the axes of the seed's map. Unknown, its steps are only where an alignment may begin.
  std::optional<Matrix6d> rate_covariance = std::nullopt;
};

/// Whether an aligned pose is as near to the seed as the gate demands.
bool agrees(const common::Pose3& T_map_camera, const CameraSeed& seed);

/// The covariance of a seed, as KeyFramePlace::covariance.
Matrix6d seedCovariance();

/// A frame that was aligned, or begins a track.
struct AlignedFrame {
  common::Pose3 T_map_camera;
  Matrix6d covariance;  ///< With the axes of the camera.
  CameraSeed seed;
};

/// What is known of a frame's pose before it is aligned: the last frame's pose with the motion of the seeds since then,
/// and the seed itself if it is a pose in the map.
PosePrior seededPrior(const AlignedFrame& last, const CameraSeed& seed, double gap_s);

/// Adds the step of a seed that is not in the map to the prior of a frame's pose, with the weight that its
/// rate_covariance allows. A step that contradicts the rest is left out, and so is one of unknown covariance.
PosePrior withSeedStep(const PosePrior& motion, const AlignedFrame& last, const CameraSeed& seed, double gap_s);

/// The place of a new key frame. `from` is the key frame that it was aligned to.
KeyFramePlace placeOfNew(const KeyFramePlace& from, const Alignment& fit, const CameraSeed& seed);

}  // namespace swiftlet::mapping3d
