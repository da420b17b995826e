// Every surface that the beams below met, cell by cell, also those that are no level: edges, slopes, and what was seen
// for a moment only. Levels are for the height of the vehicle; this is for the feet of its gear.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/level_map.hpp"
#include "perception/altitude/keyed_cells.hpp"

namespace swiftlet::perception {

/// One thread.
class SeenSurfaces {
 public:
  SeenSurfaces();

  /// Moves what was seen with the key scans of the map; see KeyedCells.
  void follow(const common::KeyPoses& keys, int newest_key) { cells_.follow(keys, newest_key); }

  /// A beam that met a surface of that height over the take-off floor. Ignores what is not finite.
  void add(const Eigen::Vector2d& point_map_m, double height_m);

  /// The vehicle stood there, on a surface of that height, with a hull of that radius.
  void stood(const Eigen::Vector2d& center_map_m, double radius_m, double height_m);

  /// The surfaces that several beams agree on, gathered by height. A cell with an edge is in several of them.
  common::LevelMap surfaces() const;

 private:
  /// Beams of one height in a cell.
  struct Cluster {
    double height_m = 0.0;  ///< Mean.
    int beams = 0;
  };
  using Clusters = std::vector<Cluster>;
  static Cluster* sameAs(std::span<Cluster> clusters, double height_m);
  Clusters clustersAt(common::CellIndex cell) const;

  KeyedCells<Clusters> cells_;
};

}  // namespace swiftlet::perception
