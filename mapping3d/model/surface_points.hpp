// The points of a frame's surfaces, with colours and normals.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

/// In the frame `camera`.
struct SeenPoint {
  Eigen::Vector3f position_m;
  Eigen::Vector3f normal;  ///< Unit length, towards the camera.
  std::array<std::uint8_t, 3> rgb{};
  float weight = 0.0F;  ///< The inverse variance of the depth, in 1/m^2.
};

/// One for each `pixel_step`-th pixel of a row and of a column, up to `range_m`, that lies on a smooth surface: a pixel
/// at an edge may have a depth between those of the two surfaces.
std::vector<SeenPoint> surfacePoints(const common::RgbdFrame& frame, int pixel_step, double range_m,
                                     const vision::DepthNoiseConfig& noise);

}  // namespace swiftlet::mapping3d
