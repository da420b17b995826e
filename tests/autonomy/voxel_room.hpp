// A 3D map for the tests: a room that a camera has seen, drawn by hand.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/key_pose.hpp"
#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// Submaps that are turned and shifted against the map. Nothing is known where nothing was drawn.
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
  /// What is drawn from now on is in another submap, which was begun so many frames after the last one was left.
  void beginSubmap(double x_m, int frames_later = 1) {
    submaps_.push_back(submap());
    voxels_ = common::VoxelMap(0.05);
    first_frame_ += static_cast<std::uint64_t>(kFrames + frames_later);
    T_map_submap_ = {common::expSO3({0.0, 0.0, -0.2}), {x_m, -0.1, 0.0}};
  }
  std::shared_ptr<const common::Map3dLayer> layer() {
    auto layer = std::make_shared<common::Map3dLayer>();
    auto keys = std::make_shared<common::KeyPoses>();
    keys->keys.push_back({{}, T_map_key_});
    std::vector<common::Submap3d> submaps = submaps_;
    submaps.push_back(submap());
    layer->submaps = std::make_shared<const std::vector<common::Submap3d>>(std::move(submaps));
    layer->keys = keys;
    return layer;
  }

 private:
  static constexpr int kFrames = 100;  ///< Of each submap.

  common::Submap3d submap() {
    common::Submap3d submap{0, common::lifted(T_map_key_, 0.0).inverse() * T_map_submap_,
                            std::make_shared<const std::vector<common::SurfacePoint>>(),
                            std::make_shared<const common::VoxelMap>(voxels_.snapshot())};
    submap.first_frame = first_frame_;
    submap.last_frame = first_frame_ + kFrames;
    return submap;
  }

  common::Pose2 T_map_key_{1.0, -2.0, 0.4};
  common::Pose3 T_map_submap_{common::expSO3({0.0, 0.0, 0.3}), {0.5, 0.2, 0.0}};
  common::VoxelMap voxels_{0.05};
  std::vector<common::Submap3d> submaps_;  ///< Those that were left.
  std::uint64_t first_frame_ = 0;
};

}  // namespace swiftlet::autonomy
