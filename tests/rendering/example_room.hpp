// The example flat in three dimensions, as an ideal RGB-D camera sees it, and a 3D map that grows from its frames.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "common/submap3d.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::testing {

/// Boxes that stand on a floor at height 0. Colours depend on the place.
class ExampleRoom {
 public:
  struct Hit {
    double distance = 0.0;  ///< In units of the ray's direction.
    Eigen::Vector3d point_map_m;
    Eigen::Vector3d normal_map;
    std::array<std::uint8_t, 3> rgb;
  };

  explicit ExampleRoom(std::vector<Eigen::AlignedBox3d> boxes) : boxes_(std::move(boxes)) {}

  /// The first surface on the ray. The direction need not have length 1.
  std::optional<Hit> hit(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& direction_map) const;
  /// 160 x 120 pixels, without noise; too far beyond 5 m, unknown nearer than 0.4 m.
  common::RgbdFrame frame(const common::Pose3& T_map_camera, common::Time stamp) const;
  /// All faces and the floor, a point every `spacing_m`.
  std::vector<common::SurfacePoint> surface(double spacing_m) const;

 private:
  std::vector<Eigen::AlignedBox3d> boxes_;
};

/// Makes submaps of some seconds each from frames; each hangs on a key scan of its own.
class ExampleMapper {
 public:
  explicit ExampleMapper(ExampleRoom room) : room_(std::move(room)) {}

  /// The layer after a frame of the camera on the vehicle.
  std::shared_ptr<const common::Map3dLayer> look(const common::Pose3& T_map_body, common::Time stamp);
  /// A loop closure that moves the key scans by their number: the i-th by i * `step_m` in x.
  std::shared_ptr<const common::Map3dLayer> bend(double step_m);

 private:
  using Cube = std::tuple<int, int, int>;

  std::shared_ptr<const common::Map3dLayer> publish();

  ExampleRoom room_;
  common::KeyPoses keys_;
  std::vector<common::Submap3d> submaps_;
  std::map<Cube, std::size_t> cubes_;          ///< The number of the point in each cube.
  std::vector<common::SurfacePoint> growing_;  ///< In the order in which their cubes were first seen.
  common::Map3dLayer layer_;
};

}  // namespace swiftlet::testing
