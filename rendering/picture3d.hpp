// The content of a picture of a 3D map. A flight or a mapped recording fills it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/submap3d.hpp"
#include "rendering/shown_frame.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::rendering {

enum class PointColor {
  kMeasured,  ///< The colour that the camera saw.
  kNormal,    ///< By the direction of the surface: x red, y green, z blue.
};

/// Points of a surface in a frame of their own.
struct PlacedSurface {
  std::shared_ptr<const std::vector<common::SurfacePoint>> points;  ///< Never null.
  common::Pose3 T_map_points;
  double cube_m = 0.02;    ///< As in Submap3d.
  std::size_t coarse = 0;  ///< As in Submap3d.
};

enum class Line3dStyle {
  kTrail,  ///< Where the vehicle has been: solid.
  kPlan,   ///< Where it is going to fly: dashed.
};

struct Line3d {
  std::vector<Eigen::Vector3d> points_map_m;
  Line3dStyle style = Line3dStyle::kTrail;
};

struct PlacedCamera {
  common::Pose3 T_map_camera;
  common::PinholeCamera lens;
};

struct PlacedVehicle {
  common::Pose3 T_map_body;
  double hull_diameter_m = 0.0;
};

struct Picture3d {
  std::vector<PlacedSurface> surfaces;
  std::vector<Line3d> lines;
  std::optional<PlacedVehicle> vehicle;
  std::optional<PlacedCamera> camera;
  std::vector<Eigen::Vector3d> targets_map_m;  ///< And patterns, found; an arrow points down at each.
  ShownFrame shown;                            ///< The lines on the floor are those of this frame.
};

/// The picture of a World: the submaps of its 3D map, the vehicle, its camera, the targets, the trail and the plan. The
/// World has no heights of the trail, so the trail is drawn on the take-off floor and the plan at the vehicle's height.
/// Without a 3D map there are no surfaces and no camera.
Picture3d picture3dOf(const common::World& world, double hull_diameter_m);

}  // namespace swiftlet::rendering
