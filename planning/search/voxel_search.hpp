// Shortest paths over the voxels of a box, without a hull: A* with octile costs (Hart, Nilsson and Raphael 1968). It
// says what the optimum is of problems whose published lengths are of this kind (Moving AI benchmarks, 3D maps).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/voxel_map.hpp"

namespace swiftlet::planning {

/// The voxels of a box, counted from 0 along each axis: free until they are blocked; outside nothing is free.
class VoxelGrid {
 public:
  /// The sides are greater than 0.
  explicit VoxelGrid(common::VoxelIndex size);

  common::VoxelIndex size() const { return size_; }
  bool contains(const common::VoxelIndex& voxel) const {
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < size_.x && voxel.y < size_.y && voxel.z < size_.z;
  }
  bool isFree(const common::VoxelIndex& voxel) const { return contains(voxel) && !blocked_[indexOf(voxel)]; }
  /// The voxel must be in the box.
  void block(const common::VoxelIndex& voxel) { blocked_[indexOf(voxel)] = true; }

 private:
  std::size_t indexOf(const common::VoxelIndex& voxel) const {
    return (static_cast<std::size_t>(voxel.z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(voxel.y)) *
               static_cast<std::size_t>(size_.x) +
           static_cast<std::size_t>(voxel.x);
  }

  common::VoxelIndex size_;
  std::vector<bool> blocked_;
};

struct VoxelPath {
  std::vector<common::VoxelIndex> voxels;  ///< From start to goal, both included.
  double length = 0.0;                     ///< In voxels: a step costs 1, the root of 2 or the root of 3.
};

/// Moves to the 26 neighbours; none cuts a corner: all voxels of the smallest box around both ends are free. It keeps
/// its memory between calls, in proportion to the voxels that were reached. One thread.
class VoxelSearch {
 public:
  /// `grid` must outlive it.
  explicit VoxelSearch(const VoxelGrid& grid);

  /// A shortest path; nullopt where there is none, or an end is not free.
  std::optional<VoxelPath> plan(const common::VoxelIndex& start, const common::VoxelIndex& goal);
  /// Voxels that the last call expanded.
  std::size_t expansions() const { return expansions_; }

 private:
  struct Node {
    std::int64_t cost = 0;
    std::uint32_t search = 0;  ///< The call in which it was reached; 0: none.
    std::int8_t step = -1;     ///< Index of the move that led to it; -1 for the start.
    bool closed = false;
  };
  static constexpr int kPageBits = 3;
  using Page = std::vector<Node>;

  Node& nodeAt(const common::VoxelIndex& voxel);
  std::uint32_t freeAround(const common::VoxelIndex& voxel) const;

  const VoxelGrid& grid_;
  common::VoxelIndex pages_size_;
  std::vector<std::unique_ptr<Page>> pages_;  ///< Cubes of nodes, made when they are reached.
  std::uint32_t search_ = 0;
  std::size_t expansions_ = 0;
};

}  // namespace swiftlet::planning
