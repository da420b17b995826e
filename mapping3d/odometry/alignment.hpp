// Aligns a frame to key frames directly: the pose at which their textured points have the same grey value in the frame
// (up to a gain and an offset of the exposure), and their points lie on the frame's surfaces (point to plane,
// associated by projection). Gauss-Newton with robust weights, from the coarsest level of the pyramid to the finest.
//
// Sources: C. Kerl, J. Sturm, D. Cremers, "Dense visual SLAM for RGB-D cameras", IROS 2013 (both errors together);
// R. Newcombe et al., "KinectFusion", ISMAR 2011 (projective association).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "mapping3d/odometry/frame_pyramid.hpp"
#include "mapping3d/odometry/reference_points.hpp"

namespace swiftlet::mapping3d {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct AlignmentConfig {
  double surface_floor_m = 0.0;

  void describe(common::config::Fields& fields);
};

/// What a frame is aligned to; refers to a key frame's points, a level each.
struct ReferenceView {
  common::Pose3 T_map_key;
  const std::vector<std::vector<ReferencePoint>>* levels = nullptr;
};

/// A picture's grey value is gain * value of the map + offset.
struct Exposure {
  double gain = 1.0;
  double offset = 0.0;
};

/// What is known of the pose beforehand.
struct PosePrior {
  common::Pose3 T_map_camera;
  /// Inverse covariance of the error (x, y, z, rotation vector) in the axes of the camera.
  Matrix6d information = Matrix6d::Zero();
};

struct Alignment {
  common::Pose3 T_map_camera;
  Exposure exposure;
  /// Inverse covariance of the error (x, y, z, rotation vector) in the axes of the camera, in m and rad.
  Matrix6d information = Matrix6d::Zero();
  /// The part of it that the frame itself gives, without the prior.
  Matrix6d measured_information = Matrix6d::Zero();
  /// What grey values that are nothing but noise would add to that, if their gradients had variance 1 along both axes:
  /// noise looks like texture.
  Matrix6d gradient_noise = Matrix6d::Zero();
  double overlap = 0.0;    ///< Part of the points that lie in the picture, and not behind what it shows.
  double agreement = 0.0;  ///< Part of those, where the depth was measured, whose depth agrees with it.
  /// Correlation of the grey values of textured points with those of the frame: near 1 at the right pose, near 0 at a
  /// wrong one, whatever the exposure. 1 if too few points are textured.
  double correlation = 1.0;
  int points = 0;    ///< Points whose depth agrees, at the finest level.
  int measured = 0;  ///< Points of which the frame measured a depth, at the finest level.
  int textured = 0;  ///< Points whose grey values were compared, at the finest level.
};

/// How well a pose fits at the coarsest level; no optimization. For the choice among predictions.
Alignment judgePose(const FramePyramid& frame, std::span<const ReferenceView> views, const common::Pose3& T_map_camera,
                    const Exposure& exposure, const vision::DepthNoiseConfig& noise, const AlignmentConfig& config);

/// Begins at the prior's pose, with the last exposure. At coarse levels only the first view counts. A pose that is
/// known to a few pixels, by corners, is given as `near`: the alignment begins there and leaves out the coarse levels,
/// on which a pattern that repeats itself looks alike in many places.
Alignment align(const FramePyramid& frame, std::span<const ReferenceView> views, const PosePrior& prior,
                const Exposure& exposure, const vision::DepthNoiseConfig& noise, const AlignmentConfig& config,
                const std::optional<common::Pose3>& near = std::nullopt);

}  // namespace swiftlet::mapping3d
