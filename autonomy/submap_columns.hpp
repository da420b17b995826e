// What a submap of the 3D map has at the height of the hull, as columns over the cells of the laser's grid.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "autonomy/planning_jobs/placed_submap.hpp"
#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::autonomy {

/// What is at the height of the hull over one voxel of the plane, within one block.
struct Column {
  common::VoxelIndex bottom;    ///< The lowest voxel of the block.
  std::uint8_t occupied = 0;    ///< Bit i: voxel i from there upwards.
  common::CellIndex cell = {};  ///< Of the laser grid.
  bool gone = false;            ///< A later submap has seen all of it free.
};

/// One thread. What was found is kept as long as nothing has changed that it depends on, so that a large map costs
/// little.
class SubmapColumns {
 public:
  /// Another submap, or one that has grown, is read from the start.
  void setVoxels(const std::shared_ptr<const common::VoxelMap>& voxels);
  /// Something that the laser saw at that height has gone from that place of the submap. What stands upright through
  /// the beams that passed there goes with it; a voxel comes back when the camera meets something in it again.
  void forget(const Eigen::Vector2d& place_m, double height_m);
  /// The height of the body for which it was read; nullopt before.
  const std::optional<double>& height_m() const { return height_m_; }
  /// Reads the blocks around that height. Returns how many those were.
  int read(double height_m, double half_hull_m);
  /// Finds the columns that the laser does not see in its grid.
  void findBesideLaser(const PlacedSubmap& submap, const std::shared_ptr<const common::OccupancyGrid>& laser_grid);
  /// Whether it is known what these later submaps have seen free.
  bool knowsGone(const std::vector<PlacedSubmap>& later) const;
  void findGone(std::vector<PlacedSubmap> later);

  const std::vector<Column>& besideLaser() const { return beside_laser_; }

 private:
  void addColumns(common::VoxelIndex block, int low, int high);
  bool hasGone(const Column& column) const;
  bool isOccupied(common::VoxelIndex voxel, int evidence) const;
  void forgetUpright(common::VoxelIndex voxel);

  std::shared_ptr<const common::VoxelMap> voxels_;
  std::map<int, std::vector<common::VoxelIndex>> layers_;  ///< The blocks of the voxels by their z.
  /// The evidence of voxels that were forgotten, and the least since: more is a new observation.
  std::map<common::VoxelIndex, std::int8_t> forgotten_;
  std::optional<double> height_m_;
  std::vector<Column> all_, beside_laser_;
  std::shared_ptr<const common::OccupancyGrid> laser_grid_;  ///< Of `beside_laser_`; null before the first time.
  PlacedSubmap placed_;                                      ///< The submap and its place then.
  common::CellRect around_;                                  ///< The cells of the laser grid that were looked at.
  std::vector<PlacedSubmap> later_;                          ///< The submaps that were checked for vacated voxels.
};
static_assert(common::VoxelBlock::kSide <= 8);

}  // namespace swiftlet::autonomy
