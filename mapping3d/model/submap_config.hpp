// How surfaces are kept in submaps.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::mapping3d {

struct SubmapConfig {
  double cube_m = 0.02;
  double point_range_m = 5.0;  ///< Farther surfaces make no points, because their noise is too great.
  double reach_m = 2.5;        ///< A submap is left when the sensor is farther from its origin.
  int points_max = 4'000'000;  ///< Points of all submaps together, at most: beyond, the oldest are thinned to cubes of
                               ///< twice the size.
  int submaps_max = 200;       ///< Submaps that are kept, at most: beyond, the oldest is forgotten.
  int blocks_max = 500'000;  ///< Blocks of 8 x 8 x 8 voxels of all submaps together, half a kilobyte each: beyond, the
                             ///< oldest are forgotten.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::mapping3d
