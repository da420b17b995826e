// From where a 3D picture is seen.
#pragma once

#include <compare>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "rendering/picture3d.hpp"

namespace swiftlet::rendering {

/// Equal viewpoints give equal pictures of the same content.
struct Viewpoint3d {
  enum class Kind {
    kWhole,   ///< Around the middle of everything known, from far enough to show all of it.
    kOrbit,   ///< Around `target`, from `distance_m`.
    kFollow,  ///< Around the vehicle, from `distance_m`; the direction does not turn with it.
    kCamera,  ///< From the RGB-D camera, with its field of view; kFollow while there is none.
  };

  Kind kind = Kind::kWhole;
  double target_x_map_m = 0.0;
  double target_y_map_m = 0.0;
  double target_z_map_m = 0.0;
  double distance_m = 4.0;
  /// Where the eye is, seen from the target: about z from the x axis of `map`, and above the horizon (negative:
  /// below). Less than a right angle.
  double azimuth_rad = -2.0;
  double elevation_rad = 0.7;

  auto operator<=>(const Viewpoint3d&) const = default;
};

/// A pinhole camera that draws the picture. The axes of `eye` are those of the frame `camera`.
struct Eye {
  common::Pose3 T_map_eye;
  common::PinholeCamera lens;
};

/// The box in `map` that holds the surfaces and the vehicle, without the outermost 1 % of the points, so that single
/// wrong points do not count. Empty if there is nothing.
Eigen::AlignedBox3d extentOf(const Picture3d& picture);

/// Of a picture of this size. Both sides are positive.
Eye eyeOf(const Viewpoint3d& viewpoint, const Picture3d& picture, int width_px, int height_px);

}  // namespace swiftlet::rendering
