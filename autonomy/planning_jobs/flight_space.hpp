// What is known of the space of a flight at all heights, for a hull that flies through windows and gaps: the voxels of
// the 3D map, the grid at the height of flight where the camera has seen nothing, people, keep-out zones.
//
//   submaps, newest last --> evidence of each voxel --+
//   grid at the height of flight, where unknown ------+--> free, occupied or unknown --> clearance of the hull
//   places of the hull itself, where unknown ---------+
//   people and keep-out zones ------------------------+
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "autonomy/planning_jobs/placed_submap.hpp"
#include "autonomy/planning_jobs/planning_request.hpp"
#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"
#include "planning/clearance/cell_states.hpp"
#include "planning/clearance/hull_space.hpp"

namespace swiftlet::autonomy {

/// One thread. Only what changed since the last update is computed again, as long as the places of vehicle and goal
/// ask for the same box.
class FlightSpace {
 public:
  explicit FlightSpace(double hull_height_m) : hull_height_m_(hull_height_m) {}

  /// The request has a 3D map. `grid` are the states of the request's grid, at `heights.cruise_m`. False without a
  /// submap, or where the box around vehicle and goal would be too large to plan in: hull() is then the last one.
  bool update(const PlanningRequest& request, const Eigen::Vector2d& goal_map_m, const FlightHeights& heights,
              const planning::CellStates& grid);

  /// Where the hull may be, with half of the footprint's clearance; after an update.
  planning::HullSpace hull(const planning::Footprint& footprint) const;
  /// A grid of the height at which a hull flies: free where all of its column is known to be free.
  common::OccupancyGrid gridAt(double height_m, const Eigen::Vector2d& around_map_m, double resolution_m) const;

 private:
  enum State : std::uint8_t { kUnknown, kFree, kOccupied };
  struct Box {
    common::VoxelIndex begin, size;  ///< In voxels, of whole blocks.
    bool operator==(const Box&) const = default;
    bool contains(const common::VoxelIndex& voxel) const {
      return voxel.x >= begin.x && voxel.y >= begin.y && voxel.z >= begin.z && voxel.x < begin.x + size.x &&
             voxel.y < begin.y + size.y && voxel.z < begin.z + size.z;
    }
  };
  Box boxAround(const Eigen::Vector2d& a_map_m, const Eigen::Vector2d& b_map_m, double highest_m) const;
  void addEvidence(const std::vector<PlacedSubmap>& submaps);
  void addEvidence(const PlacedSubmap& submap);
  void setStates(const FlightHeights& heights, const planning::CellStates& grid);
  void addFlown(const planning::Footprint& footprint);
  void closeSlivers();
  void addLayers(const PlanningRequest& request);
  void writeBlocks();
  State stateAt(const common::VoxelIndex& voxel) const;
  common::VoxelIndex voxelAt(const Eigen::Vector3d& place_map_m) const;
  std::size_t indexOf(const common::VoxelIndex& voxel) const {
    return (static_cast<std::size_t>(voxel.z - box_.begin.z) * static_cast<std::size_t>(box_.size.y) +
            static_cast<std::size_t>(voxel.y - box_.begin.y)) *
               static_cast<std::size_t>(box_.size.x) +
           static_cast<std::size_t>(voxel.x - box_.begin.x);
  }
  double middle_m() const;

  double hull_height_m_;
  double voxel_m_ = 0.0;
  Box box_;
  std::vector<PlacedSubmap> submaps_;         ///< Of `evidence_`.
  std::vector<std::int8_t> evidence_;         ///< In steps of VoxelMap::kLogOddsStep, of the voxels of the box.
  std::vector<State> states_;                 ///< Of the same voxels.
  std::vector<Eigen::Vector3d> flown_map_m_;  ///< Places of the body at the updates, in order.
  std::optional<common::VoxelMap> voxels_;    ///< The states, for the clearance.
  std::optional<planning::Clearance> clearance_;
};

}  // namespace swiftlet::autonomy
