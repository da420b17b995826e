// The image of a camera in groups: squares of pixels that are looked at as one.
#pragma once

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"

namespace swiftlet::mapping3d {

/// Coordinates (u, v) are counted in groups: group n spans [n, n + 1), while pixel n spans [n - 0.5, n + 0.5) of the
/// camera's coordinates. A point (x, y, z) of the camera is at u = cu - fu y / x and v = cv - fv z / x.
struct PixelGroups {
  PixelGroups() = default;
  /// Squares of `side` pixels; those at the right and lower edge may reach beyond the image.
  PixelGroups(const common::PinholeCamera& camera, int side)
      : side_px(side),
        width((camera.width_px + side - 1) / side),
        height((camera.height_px + side - 1) / side),
        fu(static_cast<float>(camera.fx_px) / static_cast<float>(side)),
        fv(static_cast<float>(camera.fy_px) / static_cast<float>(side)),
        cu((static_cast<float>(camera.cx_px) + 0.5F) / static_cast<float>(side)),
        cv((static_cast<float>(camera.cy_px) + 0.5F) / static_cast<float>(side)),
        first_ray(Eigen::Array2f::Constant(0.5F / static_cast<float>(side))),
        last_ray((static_cast<float>(camera.width_px) - 0.5F) / static_cast<float>(side),
                 (static_cast<float>(camera.height_px) - 0.5F) / static_cast<float>(side)) {}

  int side_px = 1;
  int width = 0, height = 0;
  float fu = 0, fv = 0, cu = 0, cv = 0;
  Eigen::Array2f first_ray, last_ray;  ///< Of the outermost pixels.
};

}  // namespace swiftlet::mapping3d
