// What a camera sees through its lens, before it measures.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::simulation {

/// Row by row from the top left; each list has a value for every pixel.
struct SeenImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> depth_m;         ///< Along the view; infinite without a surface.
  std::vector<std::uint8_t> is_weak;  ///< 1 where the surface returns too little of the projected pattern.
  std::vector<Eigen::Array4f> light;  ///< Red, green, blue, unused; white under the lamp is about 1.
  /// How far the image of the surface moves while the shutter is open; empty when nothing blurs.
  std::vector<Eigen::Vector2f> motion_px;

  std::size_t pixels() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px); }
};

}  // namespace swiftlet::simulation
