// The room that a hull has in a voxel map, computed where it is asked for.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "common/clearance.hpp"
#include "common/voxel_map.hpp"
#include "mapping3d/voxels/scan_window.hpp"

namespace swiftlet::mapping3d {

/// Distances between the hull and the cubes of the voxels are exact, so that the only error is that of the voxels: a
/// surface is anywhere within its cube. Blocks are searched from the nearest on, until the next cannot hold anything
/// nearer. What a block has of obstacles is kept until the block changes.
class ClearanceField : public common::ClearanceQuery {
 public:
  /// Clearances of `greatest_m` and more are not told apart; the cost of a query grows with its cube.
  ClearanceField(std::shared_ptr<const common::VoxelMap> map, double greatest_m);

  /// Another version of the map; of blocks that both versions share, what is known is kept. Null is no map.
  void update(std::shared_ptr<const common::VoxelMap> map);

  double clearance_m(const Eigen::Vector3d& center_map_m, const common::UprightHull& hull,
                     common::UnknownSpace unknown) override;
  double greatest_m() const override { return greatest_m_; }

 private:
  /// The voxels of a block that are obstacles, by what unknown ones count as.
  struct Obstacles {
    const common::VoxelBlock* source = nullptr;
    VoxelBits occupied, not_free;
  };
  struct Near {
    double distance_m;
    common::VoxelIndex block;
  };
  void findBlocks(const Eigen::Vector3d& center_m, const common::UprightHull& hull);
  double nearestIn(common::VoxelIndex block, const Eigen::Vector3d& center_m, const common::UprightHull& hull,
                   common::UnknownSpace unknown, double limit_m);
  const Obstacles& obstaclesOf(common::VoxelIndex block, const common::VoxelBlock& content);

  double greatest_m_;
  std::shared_ptr<const common::VoxelMap> map_;
  std::unordered_map<common::VoxelIndex, Obstacles, common::VoxelMap::Hash> obstacles_;
  std::vector<Near> near_;  ///< Of the present query.
};

}  // namespace swiftlet::mapping3d
