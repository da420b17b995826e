// A 3D map for the tests: a room that a camera has seen, drawn by hand.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// One submap that is turned and shifted against the map. Nothing is known where nothing was drawn.
class VoxelRoom {
 public:
  static constexpr std::int8_t kSeenFree = -20, kSeenOccupied = 40;

  /// Draws every voxel from `low_map_m` to `high_map_m`.
  void draw(const Eigen::Vector3d& low_map_m, const Eigen::Vector3d& high_map_m, std::int8_t evidence) {
    constexpr double kStep_m = 0.02;  // Less than half a voxel, so that none is left out however the submap is turned.
    const common::Pose3 T_submap_map = T_map_submap_.inverse();
    for (double x = low_map_m.x(); x < high_map_m.x(); x += kStep_m)
      for (double y = low_map_m.y(); y < high_map_m.y(); y += kStep_m)
        for (double z = low_map_m.z() + 0.025; z < high_map_m.z(); z += 0.05)
          voxels_.set(voxels_.voxelAt(T_submap_map * Eigen::Vector3d(x, y, z)), evidence);
  }
  std::shared_ptr<const common::Map3dLayer> layer() {
    auto layer = std::make_shared<common::Map3dLayer>();
    auto keys = std::make_shared<common::KeyPoses>();
    keys->keys.push_back({{}, {1.0, -2.0, 0.4}});
    const common::Submap3d submap{0, common::lifted(keys->keys[0].T_map_key, 0.0).inverse() * T_map_submap_,
                                  std::make_shared<const std::vector<common::SurfacePoint>>(),
                                  std::make_shared<const common::VoxelMap>(voxels_.snapshot())};
    layer->submaps = std::make_shared<const std::vector<common::Submap3d>>(1, submap);
    layer->keys = keys;
    return layer;
  }

 private:
  common::Pose3 T_map_submap_{common::expSO3({0.0, 0.0, 0.3}), {0.5, 0.2, 0.0}};
  common::VoxelMap voxels_{0.05};
};

}  // namespace swiftlet::autonomy
