#include "mapping3d/odometry/depth_time.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace swiftlet::mapping3d {
namespace {

/// Looks at a depth image from the place of the colour.
class MovedDepth {
 public:
  MovedDepth(const common::DepthImage& depth, const common::PinholeCamera& camera, const common::Pose3& T_color_depth)
      : depth_(depth),
        camera_(camera),
        rotation_color_depth_(T_color_depth.rotation.toRotationMatrix()),
        position_color_m_(T_color_depth.position_m) {}

  /// Two steps of a fixed point: the first guess of the depth says where the ray meets the surface in the other image.
  float at(int u_px, int v_px) const {
    const Eigen::Vector3d ray = camera_.point_camera_m(u_px, v_px, 1.0);
    const Eigen::Vector3d turned = rotation_color_depth_.transpose() * ray;
    const float first = depthAlong_m(turned);
    if (!common::isMeasured(first)) return first;
    const Eigen::Vector3d point = static_cast<double>(first) * ray - position_color_m_;
    return depthAlong_m(rotation_color_depth_.transpose() * point);
  }

 private:
  /// What the depth image has along a direction of its camera, as a depth from the colour's place.
  float depthAlong_m(const Eigen::Vector3d& toward_depth) const {
    if (!(toward_depth.x() > 0.0)) return common::DepthImage::kUnknown;
    const Eigen::Vector2d pixel = camera_.pixel(toward_depth);
    const auto u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= depth_.width_px || v >= depth_.height_px) return common::DepthImage::kUnknown;
    const float depth_m = depth_.at(u, v);
    if (!common::isMeasured(depth_m)) return depth_m;
    const Eigen::Vector3d point_depth_m = camera_.point_camera_m(u, v, static_cast<double>(depth_m));
    return static_cast<float>(rotation_color_depth_.row(0).dot(point_depth_m) + position_color_m_.x());
  }

  const common::DepthImage& depth_;
  const common::PinholeCamera& camera_;
  Eigen::Matrix3d rotation_color_depth_;
  Eigen::Vector3d position_color_m_;
};

}  // namespace

common::DepthImage depthFrom(const common::DepthImage& depth, const common::PinholeCamera& camera,
                             const common::Pose3& T_color_depth) {
  const MovedDepth moved(depth, camera, T_color_depth);
  common::DepthImage image{depth.width_px, depth.height_px, {}};
  image.depth_m.reserve(depth.depth_m.size());
  for (int v = 0; v < depth.height_px; ++v)
    for (int u = 0; u < depth.width_px; ++u) image.depth_m.push_back(moved.at(u, v));
  return image;
}

void moveDepth(FramePyramid& pyramid, const common::Pose3& T_color_depth) {
  pyramid.front().depth = depthFrom(pyramid.front().depth, pyramid.front().camera, T_color_depth);
  for (std::size_t level = 1; level < pyramid.size(); ++level)
    pyramid[level].depth = vision::halved(pyramid[level - 1].depth);
}

}  // namespace swiftlet::mapping3d
