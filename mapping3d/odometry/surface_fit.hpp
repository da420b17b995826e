// The plane through the measured points around a pixel.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct SurfaceFit {
  double depth_m = 0.0;           ///< Of the plane at the pixel: less noisy than the pixel's own.
  Eigen::Vector3d normal_camera;  ///< Unit length, towards the camera.
};

/// Fits the inverse depth, which on a plane is linear in the pixel, by least squares over the square of pixels at most
/// `reach_px` away that belong to the pixel's surface. nullopt at the border, at an edge, on a curved surface, or on a
/// surface that is seen too obliquely.
std::optional<SurfaceFit> fitSurface(const common::DepthImage& depth, const common::PinholeCamera& camera, int u_px,
                                     int v_px, int reach_px, const vision::DepthNoiseConfig& noise);

}  // namespace swiftlet::mapping3d
