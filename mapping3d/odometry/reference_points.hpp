// The points of a key frame that later frames are aligned to: textured ones, by their grey value, and those on smooth
// surfaces, by their tangent plane. One level of the pyramid has about the same number of points as another.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "mapping3d/odometry/frame_pyramid.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct ReferencePoint {
  Eigen::Vector3f point_camera_m;
  Eigen::Vector3f normal_camera =
      Eigen::Vector3f::Zero();  ///< Towards the camera; zero where the surface is not smooth.
  float gray = 0.0F;
  bool is_textured = false;

  bool hasNormal() const { return normal_camera.x() != 0.0F; }
};

struct ReferenceConfig {
  static constexpr int points_across =
      40;  ///< Cells in a row of the picture, each of which gives up to two points to align later frames to.
  static constexpr double least_gradient = 4.0;  ///< Gradient of a textured point, in grey levels per pixel.
  static constexpr double plane_reach_m = 0.04;  ///< A surface's plane is fitted to points this near in each direction.
};

/// The level is divided into cells, `points_across` in a row of it. Each gives its pixel of the greatest gradient and
/// the one in its middle, each if it has a reliable depth.
std::vector<ReferencePoint> referencePoints(const PyramidLevel& level, const vision::DepthNoiseConfig& noise,
                                            const ReferenceConfig& config);

}  // namespace swiftlet::mapping3d
