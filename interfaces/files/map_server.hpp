// Maps as ROS map_server stores them: a PGM picture, its first row the largest y, and a YAML file that places it.
// Source: nav2_map_server (map_io), conventions in docs/conventions.md.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

/// The greatest side of a picture that is accepted.
inline constexpr int kMostSide_px = 1 << 15;

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
};

/// Reads the YAML and the PGM that it names (relative to it); modes trinary, scale and raw, negate, P2 and P5 of up to
/// 8 bits. Throws InputError with file, line and column if they are known.
StoredMap readMap(const std::filesystem::path& yaml_file);

/// A grey picture, row by row from the top.
struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  std::string pixels;  ///< One byte for each pixel, scaled to 0..255.
};

/// Messages use `name` as the file. Throws InputError.
GreyImage parsePgm(std::string_view bytes, const std::string& name);

}  // namespace swiftlet::interfaces
