// A registered pair of a colour and a depth image, and the camera that took it.
//
// Pixel (0, 0) is the centre of the top left pixel; u counts to the right, v downwards. Points are given in the frame
// `camera` of docs/conventions.md: x along the view, y left, z up.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/image.hpp"
#include "common/stamps.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// A pinhole camera without distortion.
struct PinholeCamera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;

  bool operator==(const PinholeCamera&) const = default;
  int pixels() const { return width_px * height_px; }
  /// The point at pixel (u_px, v_px) whose distance along the view is `depth_m`.
  Eigen::Vector3d point_camera_m(double u_px, double v_px, double depth_m) const {
    return {depth_m, -(u_px - cx_px) / fx_px * depth_m, -(v_px - cy_px) / fy_px * depth_m};
  }
  /// The pixel (u, v) of a point; its x must be positive. The pixel may lie outside the image.
  Eigen::Vector2d pixel(const Eigen::Vector3d& point_camera_m) const {
    return {cx_px - fx_px * point_camera_m.y() / point_camera_m.x(),
            cy_px - fy_px * point_camera_m.z() / point_camera_m.x()};
  }
};

/// Distances along the view (not along the ray), row by row from the top left.
struct DepthImage {
  /// Nothing was measured: a hole, a dark or too near surface. Nothing is known about such a pixel's ray.
  static constexpr float kUnknown = 0.0F;
  /// The camera reports a surface beyond its range: the ray is free up to there.
  static constexpr float kTooFar = std::numeric_limits<float>::infinity();

  int width_px = 0;
  int height_px = 0;
  std::vector<float> depth_m;

  float at(int u_px, int v_px) const {
    return depth_m[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_px) +
                   static_cast<std::size_t>(u_px)];
  }
};

/// Whether the depth is a measured distance.
inline bool isMeasured(float depth_m) { return depth_m > 0.0F && std::isfinite(depth_m); }

/// One frame of an RGB-D camera. The depth is registered to the colour image, and both have the size of `camera`. A
/// stereo camera sends a pair of pictures instead, from which vision/stereo_matcher makes such a frame.
struct RgbdFrame {
  Stamps stamps;      ///< `measured` is the time of the first image row.
  Duration row_time;  ///< Between two rows; 0 for a global shutter.
  PinholeCamera camera;
  Image color;       ///< Of a pair: the picture of the left camera as it was taken, with the errors of its lens.
  DepthImage depth;  ///< Of a pair: empty.
  std::shared_ptr<const Image> right = {};  ///< Of a pair: the picture of the right camera. Null otherwise.
};

}  // namespace swiftlet::common
