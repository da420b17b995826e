// A box-shaped room with textured walls, as an RGB-D camera sees it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::mapping3d {

inline double latticeValue(int i, int j, int wall) {
  std::uint32_t h = static_cast<std::uint32_t>(i) * 0x9e3779b1U ^ static_cast<std::uint32_t>(j) * 0x85ebca6bU ^
                    static_cast<std::uint32_t>(wall) * 0xc2b2ae35U;
  h ^= h >> 15;
  h *= 0x2c1b3c6dU;
  h ^= h >> 13;
  return static_cast<double>(h & 0xffU) / 255.0;
}

/// Smooth between the points of a lattice.
inline double textureAt(double a_m, double b_m, int wall, double lattice_m) {
  const double a = a_m / lattice_m, b = b_m / lattice_m;
  const int i = static_cast<int>(std::floor(a)), j = static_cast<int>(std::floor(b));
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double fa = smooth(a - i), fb = smooth(b - j);
  const double top = latticeValue(i, j, wall) * (1.0 - fa) + latticeValue(i + 1, j, wall) * fa;
  const double bottom = latticeValue(i, j + 1, wall) * (1.0 - fa) + latticeValue(i + 1, j + 1, wall) * fa;
  return top * (1.0 - fb) + bottom * fb;
}

struct TexturedRoom {
  Eigen::Vector3d half_size_m{2.6, 2.1, 1.4};
  int walls = 0;              ///< Added to the number of a wall: another room has another texture.
  bool is_symmetric = false;  ///< It looks the same after half a turn about the vertical.
  common::PinholeCamera camera{320, 240, 290.0, 290.0, 159.5, 119.5};
  double noise_per_m2 = 1.45e-3;
  double contrast = 1.0;    ///< Of the texture; 0: bare walls.
  double gray_noise = 0.0;  ///< Standard deviation, in grey levels.
  double vignetting = 0.0;  ///< By this share the corners are darker.

  /// The picture from a pose inside, at a time; `gain` is that of the exposure.
  common::RgbdFrame seen(const common::Pose3& T_map_camera, double time_s, double gain = 1.0) const {
    common::RgbdFrame frame;
    frame.stamps.measured = frame.stamps.arrived = common::Time::fromSeconds(time_s);
    frame.camera = camera;
    frame.color = {camera.width_px, camera.height_px, {}};
    frame.depth = {camera.width_px, camera.height_px, {}};
    common::RandomStream random(11, "depth", static_cast<std::uint64_t>(1e3 * time_s));
    common::RandomStream gray_random(11, "gray", static_cast<std::uint64_t>(1e3 * time_s));
    for (int v = 0; v < camera.height_px; ++v)
      for (int u = 0; u < camera.width_px; ++u) {
        const Eigen::Vector3d ray = T_map_camera.rotation * camera.point_camera_m(u, v, 1.0);
        double depth_m = 1e9;
        int axis = 0;
        for (int i = 0; i < 3; ++i) {
          const double wall_m = ray[i] > 0.0 ? half_size_m[i] : -half_size_m[i];
          const double at_m = (wall_m - T_map_camera.position_m[i]) / ray[i];
          if (std::abs(ray[i]) > 1e-12 && at_m < depth_m) {
            depth_m = at_m;
            axis = i;
          }
        }
        const Eigen::Vector3d hit = T_map_camera.position_m + depth_m * ray;
        const bool half_turned = is_symmetric && axis < 2 && ray[axis] < 0.0;
        const int wall = walls + 2 * axis + (ray[axis] > 0.0 || half_turned ? 1 : 0);
        // Half a turn about the vertical changes the signs of x and y.
        const auto along = [&](int i) { return half_turned && i < 2 ? -hit[i] : hit[i]; };
        const double a = along((axis + 1) % 3), b = along((axis + 2) % 3);
        const double texture = 120.0 * textureAt(a, b, wall, 0.25) + 60.0 * textureAt(a, b, wall + 50, 0.07);
        const double aside = std::hypot((u - camera.cx_px) / camera.cx_px, (v - camera.cy_px) / camera.cy_px);
        const double light = gain * (1.0 - 0.5 * vignetting * aside * aside);
        const double noise = gray_noise > 0.0 ? gray_random.gaussian(gray_noise) : 0.0;
        const double gray = light * (contrast > 0.0 ? 30.0 + contrast * texture : 120.0) + noise;
        const auto value = static_cast<std::uint8_t>(std::clamp(gray, 0.0, 255.0));
        frame.color.rgb.insert(frame.color.rgb.end(), {value, value, value});
        frame.depth.depth_m.push_back(static_cast<float>(depth_m + random.gaussian(noise_per_m2 * depth_m * depth_m)));
      }
    return frame;
  }
};

}  // namespace swiftlet::mapping3d
