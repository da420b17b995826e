// A world made from a map: one mesh, the surface of the map's free space, and a start.
#pragma once

#include <filesystem>
#include <vector>

#include "common/geometry.hpp"
#include "mapping3d/voxels/free_surface.hpp"
#include "simulation/scenario.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::apps {

struct MadeWorld {
  std::vector<mapping3d::Quad> surface_map_m;
  common::Pose2 T_world_map;      ///< Of a floor plan that is turned.
  simulation::StartConfig start;  ///< In the world.
};

/// The mesh that belongs to a world: "hall.sdf" -> "hall.stl".
std::filesystem::path meshOf(const std::filesystem::path& world_file);

/// As loadWorld reads it from the file.
simulation::WorldModel modelOf(const MadeWorld& world, const std::filesystem::path& world_file);

/// Writes the mesh and the world, each in one step; if one fails, neither is left. Returns the bytes written. Throws
/// InputError.
std::size_t writeWorld(const MadeWorld& world, const std::filesystem::path& world_file);

}  // namespace swiftlet::apps
