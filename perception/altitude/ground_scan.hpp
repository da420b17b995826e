// The beams of one scan that hit the ground or an object on it, grouped into surfaces. Private to altitude.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"
#include "perception/altitude/height_measurement.hpp"
#include "perception/altitude/level_store.hpp"

namespace swiftlet::perception::altitude {

/// The beams of one scan that hit one surface.
struct SurfaceSight {
  double distance_below_m = 0.0;  ///< Mean.
  int beams = 0;
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();
  std::vector<common::CellIndex> cells;  ///< Of the beams, some more than once.
};

/// Groups the beams by gaps between the sorted distances (Grzonka 2012, Algorithm 1, line 13): the surface that most
/// beams hit comes first. Leaves out beams without a return, and surfaces hit by too few beams, which are outliers.
std::vector<SurfaceSight> surfacesBelow(std::span<const GroundPoint> points, const LevelStore& store);

/// Distance down to the highest of them; nullopt if there is none.
std::optional<double> distanceToHighest_m(std::span<const SurfaceSight> sights);

}  // namespace swiftlet::perception::altitude
