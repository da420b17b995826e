// The map in which `swiftlet plan` plans: a plane of cells, or a space of voxels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"

namespace swiftlet::apps {

struct PlanMapOptions {
  std::string from;                    ///< The file.
  std::optional<double> resolution_m;  ///< Of the voxels of a cloud, or the cells of a grid without metres.
  std::optional<double> scale;         ///< Metres in a unit of a cloud.
};

struct PlanMap {
  std::optional<common::OccupancyGrid> plane;
  std::optional<common::VoxelMap> space;
  common::Pose2 T_file_map;  ///< Of a floor plan that is turned: the frame of the file, in which places are given.
  std::vector<std::string> notes;  ///< What was assumed, for people.
};

/// Throws InputError for a file that cannot be used, or is too large.
PlanMap readPlanMap(const PlanMapOptions& options);

}  // namespace swiftlet::apps
