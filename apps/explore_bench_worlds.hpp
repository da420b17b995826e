// The buildings in which `swiftlet explore-bench` compares explorers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/occupancy_grid.hpp"

namespace swiftlet::apps {

/// A building in the plane, and where it is entered.
struct BenchWorld {
  std::string name;  ///< The file without its folder.
  common::OccupancyGrid plan = common::makeOccupancyGrid(0.05);
  std::optional<Eigen::Vector2d> start_m;  ///< As the world names it; nullopt: anywhere.
};

struct BenchWorldOptions {
  std::vector<std::string> places;       ///< Files, and folders that are searched with all folders below.
  std::optional<double> cell_m;          ///< Of the cells of a grid without metres.
  std::vector<std::string> model_paths;  ///< Of the models of worlds.
};

/// The files of the places, those of a folder by name: floor plans (.yaml), grids (.map) and worlds (.sdf, .world), the
/// last only where no floor plan of the same name is beside it. Throws InputError for a place without any.
std::vector<std::string> benchFiles(const std::vector<std::string>& places);

/// A world is cut at the height of flight, 1 m above its start. Throws InputError for a file that cannot be used.
BenchWorld readBenchWorld(const std::string& file, const BenchWorldOptions& options);

}  // namespace swiftlet::apps
