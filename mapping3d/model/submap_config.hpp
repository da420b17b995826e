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

/// Of submaps from depth images, which have far more pixels than a map needs points.
struct ImageSubmapConfig : SubmapConfig {
  static constexpr int pixel_step = 2;  ///< Every n-th pixel of a row and of a column makes a point.
  static constexpr int frame_step = 3;  ///< Every n-th frame makes points; all frames change the occupancy.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::mapping3d
