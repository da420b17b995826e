// A round room with textured walls. Only the texture tells how far the camera has turned, so an error of the intrinsics
// becomes a drift of the heading; in a room with corners the surfaces would hold it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"

namespace swiftlet::mapping3d {

struct RoundRoom {
  double radius_m = 2.6;
  double half_height_m = 1.4;
  int walls = 0;                                    ///< Another number is another texture.
  double blank_from_rad = 0.0, blank_to_rad = 0.0;  ///< A blank stretch of the wall, from 0 to 2 pi.
  common::PinholeCamera camera{320, 240, 290.0, 290.0, 159.5, 119.5};

  common::RgbdFrame seen(const common::Pose3& T_map_camera, double time_s) const {
    common::RgbdFrame frame;
    frame.stamps.measured = frame.stamps.arrived = common::Time::fromSeconds(time_s);
    frame.camera = camera;
    frame.color = {camera.width_px, camera.height_px, {}};
    frame.depth = {camera.width_px, camera.height_px, {}};
    common::RandomStream random(12, "depth", static_cast<std::uint64_t>(1e3 * time_s));
    const Eigen::Vector3d& from = T_map_camera.position_m;
    const Eigen::Matrix3d rotation = T_map_camera.rotation.toRotationMatrix();
    for (int v = 0; v < camera.height_px; ++v)
      for (int u = 0; u < camera.width_px; ++u) {
        const Eigen::Vector3d ray = rotation * camera.point_camera_m(u, v, 1.0);
        const double a = ray.head<2>().squaredNorm(), b = from.head<2>().dot(ray.head<2>());
        const double c = from.head<2>().squaredNorm() - radius_m * radius_m;
        const double wall_m = (-b + std::sqrt(b * b - a * c)) / a;
        const double flat_m = (std::copysign(half_height_m, ray.z()) - from.z()) / ray.z();
        const double depth_m = std::min(wall_m, flat_m);
        const Eigen::Vector3d hit = from + depth_m * ray;
        const bool is_wall = wall_m < flat_m;
        const double at_rad = std::numbers::pi + std::atan2(-hit.y(), -hit.x());
        const bool is_blank = at_rad > blank_from_rad && at_rad < blank_to_rad;
        const double along_m = is_wall ? radius_m * at_rad : hit.x();
        const double across_m = is_wall ? hit.z() : hit.y();
        const int wall = walls + (is_wall ? 0 : ray.z() > 0.0 ? 1 : 2);
        const double gray = 30.0 + 120.0 * textureAt(along_m, across_m, wall, 0.25) +
                            60.0 * textureAt(along_m, across_m, wall + 50, 0.07);
        const auto value = static_cast<std::uint8_t>(is_blank ? 128.0 : std::min(gray, 255.0));
        frame.color.rgb.insert(frame.color.rgb.end(), {value, value, value});
        frame.depth.depth_m.push_back(static_cast<float>(depth_m + random.gaussian(1.45e-3 * depth_m * depth_m)));
      }
    return frame;
  }
};

}  // namespace swiftlet::mapping3d
