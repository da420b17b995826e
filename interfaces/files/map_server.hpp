// Maps as ROS map_server stores them: a PGM picture, its first row the largest y, and a YAML file that places it.
// Source: nav2_map_server (map_io), conventions in docs/conventions.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

/// The known part of a grid as a binary PGM: 0 occupied, 254 free, 205 unknown. An empty grid gives one unknown pixel.
std::string toPgm(const common::OccupancyGrid& grid);

/// Whether readMap accepts the picture of the known part of a grid: neither a side nor the file is too large.
bool isReadable(const common::OccupancyGrid& grid);

/// The YAML of the picture: mode trinary, negate 0, origin the lower left corner of the lower left pixel in `map`.
/// `image` is the picture's file name.
std::string toMapYaml(const common::OccupancyGrid& grid, const std::string& image);

/// Writes FOLDER/NAME.pgm, then FOLDER/NAME.yaml, each in one step.
[[nodiscard]] Written writeMap(const std::filesystem::path& folder, const std::string& name,
                               const common::OccupancyGrid& grid, Durability durability = Durability::kProcess);

/// A map that was read. Cells are occupied or free with full confidence, or unknown. `T_map_grid` places the grid's
/// frame in the file's `map` frame. It is the identity if the file's origin lies on the lattice of cells, as in maps of
/// Swiftlet. Otherwise it is the rest of the origin: at most half a cell, or the rotation of a turned map.
struct StoredMap {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  common::Pose2 T_map_grid;
  common::SourceLocation resolution_location = {}, image_location = {};  ///< Of these keys in the YAML, for messages.
  std::vector<common::Problem> notes = {};  ///< What is odd about the files, and how it was taken.
};

/// Reads the YAML and the picture that it names (relative to it; see map_picture.hpp for its kinds); modes trinary,
/// scale and raw, negate. Keys of other programs are left out with a note. A picture that is not where the YAML says is
/// taken, with a note, if it lies beside the YAML. Throws InputError with file, line and column if they are known.
StoredMap readMap(const std::filesystem::path& yaml_file);

}  // namespace swiftlet::interfaces
