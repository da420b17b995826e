// The 3D map at places of the map from one height to another: whether a hull that reaches from the one to
// the other may be there.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "autonomy/planning_jobs/placed_submap.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// Free only where every voxel was seen to be free: a hull is not sent into unseen space. Voxels that a later submap
/// shows as free are not occupied.
enum class ColumnState { kUnknown, kFree, kOccupied };

/// One thread. Reads submaps whose origin is within reach of a place.
class VoxelColumns {
 public:
  /// Heights are over the take-off floor; the voxels of the floor itself are ignored. Submaps farther from
  /// `around_map_m` than a camera sees beyond `reach_m` are left out.
  VoxelColumns(const common::Map3dLayer& layer, double low_m, double high_m, const Eigen::Vector2d& around_map_m,
               double reach_m);

  ColumnState at(const Eigen::Vector2d& place_map_m) const;

 private:
  struct Source {
    PlacedSubmap submap;
    std::vector<PlacedSubmap> later;
  };
  void mark(const Source& source, const Eigen::Vector2d& place_map_m, std::vector<ColumnState>& states) const;

  double low_m_, high_m_;
  std::vector<Source> sources_;
  mutable std::vector<ColumnState> states_;  ///< Of the voxels of the present column.
};

}  // namespace swiftlet::autonomy
