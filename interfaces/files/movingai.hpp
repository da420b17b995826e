// Grids and path problems of the Moving AI benchmarks (Sturtevant 2012, "Benchmarks for Grid-Based Pathfinding"), plain
// or compressed by gzip, bzip2 or xz. Paths go in eight directions and cut no corners.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/occupancy_grid.hpp"

namespace swiftlet::interfaces {

/// A `.map` file. Its rows are counted from the top; the grid's y is upwards, and its cell (0, 0) is the lower left
/// one. Ground (`.`, `G`) and swamp (`S`) are free; all else (`@`, `O`, `T`, and water `W`, which no ground leads to)
/// is occupied.
struct OctileMap {
  common::OccupancyGrid grid;
  int width = 0;
  int height = 0;

  common::CellIndex cellAt(int column, int row) const { return {column, height - 1 - row}; }
};

/// Sides of a map, at most.
inline constexpr int kMostOctileCells = 16'384;

/// `cell_m`: the side of its cells, of which the file says nothing. Throws InputError.
OctileMap readOctileMap(const std::filesystem::path& file, double cell_m);
/// Reads the bytes of a file as readOctileMap() does. Messages use `name` as the file.
OctileMap parseOctileMap(std::string_view bytes, const std::string& name, double cell_m);

/// A line of a `.scen` file. Columns and rows are those of the map's file.
struct GridProblem {
  int start_column = 0, start_row = 0;
  int goal_column = 0, goal_row = 0;
  double optimal_length = 0.0;  ///< In cells; a diagonal step is the square root of 2.
  int line = 0;                 ///< Of the file.
};

/// Throws InputError, also for problems that are not of a map of this size.
std::vector<GridProblem> readGridProblems(const std::filesystem::path& file, int width, int height);
std::vector<GridProblem> parseGridProblems(std::string_view bytes, const std::string& name, int width, int height);

}  // namespace swiftlet::interfaces
