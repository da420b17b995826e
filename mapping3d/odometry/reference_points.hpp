// The points of a key frame that later frames are aligned to: textured ones, by their grey value, and those on smooth
// surfaces, by their tangent plane. One level of the pyramid has about the same number of points as another.
#pragma once

#include <vector>

#include <Eigen/Core>

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

/// The level is divided into cells, 40 in a row of it. Each gives its pixel of the greatest gradient and
/// the one in its middle, each if it has a reliable depth.
std::vector<ReferencePoint> referencePoints(const PyramidLevel& level, const vision::DepthNoiseConfig& noise);

}  // namespace swiftlet::mapping3d
